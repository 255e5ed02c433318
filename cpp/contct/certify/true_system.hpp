// A problem's equations in pairs of doubles, from the decimals that its file has, and how far rounding can
// put them off.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contct/structure/equations.hpp"

namespace contct::certify {

using numeric::double_double;
using long_vector = std::vector<double_double>;

/// Every entry of K is off by at most this share of sqrt(K_ii K_jj), every other number by this share of
/// itself: the element formulas take fewer than a hundred operations, each good to 2^-100 (double_double),
/// on decimals good to 2^-94.
inline constexpr double true_rounding = 0x1p-90;

using true_pair = structure::pair_in<double_double>;

/// What acts at the end of a step.
struct true_loads : structure::loads_in<double_double> {
  int step = 0;  ///< at whose end they act, from 1; 0 in between
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

struct true_system : structure::equations<double_double> {
  true_system() = default;
  explicit true_system(structure::equations<double_double> e) : equations(std::move(e)) {}

  std::vector<double> root;    ///< [dofs] sqrt(K_ii), rounded up
  std::vector<char> deflects;  ///< [dofs] 1: a deflection, 0: a slope
  double span = 0.0;           ///< the largest side of the structure; 0 where it has none
  /// The least that the formulas of its elements multiply: a cube of a length, a stiffness.
  double least_product = 1.0;
  /// Loads at the end of a step, from 1.
  std::function<true_loads(int step)> loads;
  /// What is read off the elements under displacements u [dofs] at the end of a step.
  std::function<std::vector<element_value>(int step, std::span<const double_double> u)> element_values;

  /// sum += K u; and sizes_i += the sum of sqrt(K_ii K_jj) |u_j| over the entries of row i, unless `sizes` is
  /// empty. All [dofs].
  void add_product(std::span<const double_double> u, std::span<double_double> sum,
                   std::span<double> sizes = {}) const;
};

/// `p` must outlive it.
[[nodiscard]] true_system true_system_of(const problem& p);

}  // namespace contct::certify
