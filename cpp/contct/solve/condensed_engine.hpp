// Beams: the stiffness condensed onto the nodes with pairs, swept from both ends.
#pragma once

#include <cstdint>
#include <vector>

#include "contct/solve/drift_monitor.hpp"
#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/spring_engine.hpp"

namespace contct::solve {

/// A 2 x 2 matrix or a vector over a node's two dofs, w and theta.
struct node_vector {
  double w = 0.0, theta = 0.0;
};
struct node_matrix {
  double ww = 0.0, wt = 0.0, tw = 0.0, tt = 0.0;
};

/// For structures whose nodes form a chain, with two dofs each. The nodes without pairs are eliminated once,
/// exactly. What remains is block tridiagonal, K = [D_i, E_i], and is kept as two sweeps:
///
///     L_i = D_i - E_{i-1}^T L_{i-1}^-1 E_{i-1}   from the left,   R_i from the right in the same way
///
/// The column of the inverse at pair p begins with (L_p + R_p - D_p)^-1 and goes outwards by -L_i^-1 E_i and
/// its mirror image, until it is below rounding. A toggle at p changes L to its right and R to its left, and
/// the sweeps stop where they give the same to the bit. On a beam with many supports both happen within some
/// tens of them: the cost of an event does not depend on the length of the beam.
class condensed_engine final : public spring_engine {
 public:
  /// Is this a beam with pairs, stored as a band?
  [[nodiscard]] static bool suits(const linear_structure& s);
  explicit condensed_engine(const linear_structure& s);
  [[nodiscard]] std::string_view name() const override { return "condensed"; }
  void respond(const residual_load& residual, std::span<double> d_star) override;
  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;

 private:
  void condense();
  void eliminate_between(int left_node, int right_node, std::size_t left);
  void step_right(std::size_t i);
  void step_left(std::size_t i);
  void sweep_from(std::size_t at);
  bool update(int pair);  // true: it takes no new factor
  /// Column of the inverse at place `at`, from first_ to last_.
  void inverse_column(std::size_t at);
  void respond_anew(const residual_load& residual);
  void refine_response();
  void residual_of_response();

  std::vector<std::size_t> place_;               // of each pair's node among the kept ones [pairs]
  std::vector<int> kept_;                        // nodes with pairs, from 0, in order
  std::vector<double> spring_factor_;            // [pairs] 1, or 0 where the dof is fixed
  std::vector<node_matrix> d_, e_;               // D_i; E_i couples i (rows) with i + 1 (columns)
  std::vector<node_matrix> left_, right_;        // L_i, R_i
  std::vector<node_matrix> go_left_, go_right_;  // -L_i^-1 E_i; -R_i^-1 E_{i-1}^T
  std::vector<double> reach_;                    // sqrt(D_tt / D_ww): a rotation's weight as a length
  std::vector<node_vector> x_, load_, column_;
  std::size_t first_ = 0, last_ = 0;  // of the column
  std::uint64_t response_to_ = 0;
  drift_monitor drift_;
  factored_stiffness stiffness_;
};

}  // namespace contct::solve
