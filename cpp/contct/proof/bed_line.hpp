// The line w1: the deflection of a beam on beds whose pressure acts along the beam, not at its nodes. What it
// proves about the mesh is in results/mesh_error.hpp; symbols are those of reference/mesh-error.md.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contct/path/structure_state.hpp"
#include "contct/proof/line_part.hpp"
#include "contct/proof/scaled_stiffness.hpp"
#include "contct/structure/extremes.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// A problem with its elements halved until the pressure of the beds changes each element's deflection
/// little, so that P converges quickly.
struct fine_mesh {
  /// The node at node `n` of the problem, and the element at the left end of its element `n`.
  [[nodiscard]] int at(int n) const { return n << halvings; }

  problem fine;
  int halvings = 0;
  bool coarse = false;  ///< the elements are too long for P to converge
};

class bed_line {
 public:
  /// The line of the program's state `told` of `p`, a beam with beds and without shear flexibility, on
  /// its fine mesh.
  bed_line(const problem& p, std::shared_ptr<const fine_mesh> fine, const structure_state& told);

  /// Solves for the line, and moves the ends of contact to where depths are 0, until both hardly change, or
  /// 50 times. Returns why there is no line, or "".
  [[nodiscard]] std::string settle();

  /// The equations of the beam on two-sided beds along these stretches, with the pairs of [[contact]].
  [[nodiscard]] long_system system_with(stretch bed_along::*where) const;
  /// The loads, with those that P adds to the beds' springs.
  [[nodiscard]] long_loads loads() const;
  /// The stiffness of a system_with, ready to be factored. Its proof is kept.
  [[nodiscard]] scaled_stiffness scaled(const long_system& s) const {
    return {s, rows_, on_.hinges.empty() ? 3 : 4, false, true};
  }

  const std::shared_ptr<const fine_mesh> mesh;
  std::vector<line_element> elements;
  long_vector u;             ///< [dofs] of the nodes, then the rotations left of hinges
  bool settled = false;      ///< further passes would hardly change the line
  std::vector<int> pressed;  ///< the pairs of [[contact]] in contact, from 0
  std::vector<double> ends;  ///< of contact, ascending
  std::vector<int> closed;   ///< the pairs of A
  std::unique_ptr<const long_system> with_pressed;  ///< system_with(&bed_along::pressed)
  std::optional<stiffness_proof> held;              ///< the proof of mu

 private:
  [[nodiscard]] bool divide();
  [[nodiscard]] bool has_end_in(const std::vector<double>& places, int e) const;
  void add_beds(line_part& part, int e) const;
  void carry_over(const line_element& old, line_element& now) const;
  [[nodiscard]] bool solve();
  [[nodiscard]] double press(line_part& part, const line_element& on) const;
  void evaluate();
  [[nodiscard]] std::vector<double> ends_found() const;
  [[nodiscard]] bool is_settled(const std::vector<double>& next) const;

  const beam& on_;
  const load& acting_;
  line<double_double> points_;
  std::size_t powers_ = 12;  // of the polynomials of P
  std::vector<int> rows_;
  double energy_ = 0.0;             // twice the beam's, nearly
  std::vector<double> divided_at_;  // the ends of contact at which elements are divided
  std::vector<long_pair> pairs_;    // those of [[contact]], with their moves
  struct bed_node {
    double_double face = {};  // its move, with the face unless that is a polynomial
    bool presses = false;     // in the state that the line begins with
  };
  std::vector<std::vector<std::optional<bed_node>>> nodes_;  // [beds][nodes of the problem]
};

}  // namespace contct
