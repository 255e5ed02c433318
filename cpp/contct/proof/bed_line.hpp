// The line w1: the deflection of a beam on beds whose pressure acts along the beam, not at its nodes. What it
// proves about the mesh is in results/mesh_error.hpp; symbols are those of reference/mesh-error.md.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contct/path/structure_state.hpp"
#include "contct/proof/polynomial_bounds.hpp"
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

/// A bed along a part of an element.
struct bed_along {
  std::size_t bed;  ///< from 0
  int surface;
  double_double modulus;
  long_vector face;                      ///< a polynomial
  std::array<double_double, 4> of_face;  ///< hermite_part::products of the face
  stretch pressed = {};                  ///< the whole part if P has the pressure of the bed, otherwise empty
  stretch certain = {};                  ///< in the set A: where the bed certainly presses
};

/// Hermite's functions of an element of length h, as polynomials in s, from 0 to 1 along a part of the
/// element, and integrals over s of their products.
struct hermite_part {
  hermite_part(const double_double& h, const double_double& from, const double_double& share,
               std::size_t powers);

  /// The integral of each function times the polynomial p.
  template <class Polynomial>
  [[nodiscard]] std::array<double_double, 4> products(const Polynomial& p) const;
  /// The same of one function, rounded.
  [[nodiscard]] double product(std::size_t function, const line_polynomial<double>& p) const;

  double_double of_h, at, along;
  std::array<long_vector, 4> shapes, moments;  ///< moments[i][m]: the integral of function i times s^m
  std::array<std::array<double_double, 4>, 4> stiffness;  ///< the integrals of products of two functions
};

/// A part of an element along which load, beds and faces are polynomials in s, from 0 to 1.
// NOLINTNEXTLINE(bugprone-exception-escape): moving numbers throws nothing
struct line_part {
  element_piece load;
  double_double from, share;  ///< its left end and its length, as shares of the element's length
  std::shared_ptr<const hermite_part> hermite;
  std::vector<bed_along> beds = {};
  line_polynomial<double> before = {};                      ///< b of the pass before, from which P is made
  line_polynomial<double> pressure = {};                    ///< P, upward, rounded
  line_polynomial<double> beyond = {};                      ///< b, rounded
  line_polynomial<double> w = {}, moment = {}, shear = {};  ///< of w1, rounded
  double slack = 0.0;       ///< a bound on the rounding of w, of w_I and of faces
  double slack_of_b = 0.0;  ///< the same of b, and of faces in 32 digits
  double off = 0.0;         ///< a bound on |r|

  /// n (w1 - c) of a bed.
  [[nodiscard]] line_polynomial<double> depth(const bed_along& b) const;
  /// b - `before`.
  [[nodiscard]] line_polynomial<double> late() const;
  /// The sum of the moduli of all beds.
  [[nodiscard]] double modulus() const;
};

struct line_element {
  std::array<int, 4> dofs;
  double_double h, EI;
  std::array<double_double, 4> work;  ///< of the loads on Hermite's functions
  std::vector<line_part> parts = {};
  double slack = 0.0;  ///< a bound on the rounding of moments and, divided by h, of shears

  /// The largest sum of moduli of a part.
  [[nodiscard]] double modulus() const;
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
