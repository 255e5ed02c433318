// A problem's equations without the rounding of its assembly: K, loads, faces and springs as pairs of
// doubles, from the decimals that its file has. exact/exact_problem assembles the same in fractions; these
// share the element formulas and nothing else, so that the exact answer can judge a proof.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contct/numeric/double_double.hpp"
#include "contct/structure/problem.hpp"

namespace contct::certify {

using numeric::double_double;
using long_vector = std::vector<double_double>;

/// Every entry of K is off by at most this share of sqrt(K_ii K_jj), every other number by this share of
/// itself: the element formulas take fewer than a hundred operations, each good to 2^-100 (double_double),
/// on decimals good to 2^-94.
inline constexpr double true_rounding = 0x1p-90;

/// Symmetric, all entries of each row.
struct long_matrix {
  std::vector<std::size_t> starts = {0};  ///< [rows + 1]
  std::vector<int> columns;               ///< [entries]
  long_vector values;                     ///< [entries]

  [[nodiscard]] std::size_t order() const { return starts.size() - 1; }
};

/// A candidate pair: n, its face c and its stiffness k.
struct true_pair {
  int dof = 0;
  int surface = 0;
  double_double face, stiffness;
};

/// What acts at the end of a step.
struct true_loads {
  int step = 0;              ///< at whose end they act, from 1; 0 in between
  long_vector force;         ///< [dofs] consistent loads
  std::vector<double> size;  ///< [dofs] the sum of their parts' magnitudes
  long_vector settlement;    ///< [dofs] what fixed dofs are moved to; 0 at all others
};

/// A value at the end of an element, in the order of structure::element_results.
struct element_value {
  double_double value;
  double size = 0.0;    ///< the sum of the magnitudes that make it
  double energy = 0.0;  ///< |error| <= energy * rho, see reference/certificate.md
  bool moment = true;   ///< otherwise a shear
};

/// K u less the loads and what pairs beyond their faces press with, at every dof, each number rounded once:
/// of double_doubles u [dofs] at the end of a step, from 1. At fixed dofs u is the prescribed displacement.
/// Nothing where that would take too long.
using exact_residual = std::function<std::optional<long_vector>(int step, std::span<const double_double> u)>;

/// Is a matrix positive semidefinite on the dofs that are not fixed? Nothing where deciding it would take too
/// long.
using semidefinite_test = std::function<std::optional<bool>()>;

struct true_system {
  long_matrix k;               ///< of elements and elastic supports, rows of fixed dofs too
  long_vector diagonal;        ///< [dofs] of K
  std::vector<double> root;    ///< [dofs] sqrt(K_ii), rounded up
  std::vector<char> fixed;     ///< [dofs]
  std::vector<char> deflects;  ///< [dofs] 1: a deflection, 0: a slope
  std::vector<true_pair> pairs;
  double span = 0.0;  ///< the largest side of the structure; 0 where it has none
  /// The least that the formulas of its elements multiply: a cube of a length, a stiffness.
  double least_product = 1.0;
  /// Loads at the end of a step, from 1.
  std::function<true_loads(int step)> loads;
  /// What is read off the elements under displacements u [dofs] at the end of a step.
  std::function<std::vector<element_value>(int step, std::span<const double_double> u)> element_values;

  [[nodiscard]] std::size_t dofs() const { return fixed.size(); }

  /// sum += K u; and sizes_i += the sum of sqrt(K_ii K_jj) |u_j| over the entries of row i, unless `sizes` is
  /// empty. All [dofs].
  void add_product(std::span<const double_double> u, std::span<double_double> sum,
                   std::span<double> sizes = {}) const;
};

/// `p` must outlive it.
[[nodiscard]] true_system true_system_of(const problem& p);

}  // namespace contct::certify
