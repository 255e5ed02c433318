// The equations of a problem in 32 digits (double_double), from the decimals in its file, with bounds on
// their rounding.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "contct/structure/equations.hpp"

namespace contct {

using long_vector = std::vector<double_double>;

/// Bound on rounding: the error of an entry K_ij is at most this share of sqrt(K_ii K_jj), that of any other
/// number of the equations this share of the number. Element formulas take fewer than a hundred operations
/// with relative errors of up to 2^-100 (double_double), on decimals with relative errors of up to 2^-94.
inline constexpr double long_rounding = 0x1p-90;
/// Bound on the rounding of sums of doubles, as a share of the sum of magnitudes.
inline constexpr double summation_slack = 0x1p-30;

using long_pair = pair_in<double_double>;

struct long_loads : loads_in<double_double> {
  int step = 0;  ///< the step at whose end the loads act, from 1; 0: not at the end of a step
};

struct long_residual {
  long_vector force;          ///< the residual r; 0 at fixed dofs [dofs]
  std::vector<double> slack;  ///< bound on the error of `force` [dofs]
  long_vector needed;         ///< see equations::needed; at fixed dofs the reaction [dofs]
};

/// A moment or shear at the end or corner of an element. Values are in the order of element_results.
struct element_value {
  double_double value;
  double size = 0.0;    ///< sum of the magnitudes of the terms of `value`
  double energy = 0.0;  ///< |error| <= energy * rho, see reference/certificate-proof.md
  bool moment = true;   ///< false: a shear

  /// A bound on the rounding of `value`: lengths, coordinates and moduli enter at most ten times, each with a
  /// relative error of up to 2^-94. Displacements are exact, except for prescribed ones (settled_share).
  [[nodiscard]] double noise() const { return 4 * long_rounding * size; }
};

struct long_system : equations<double_double> {
  long_system() = default;
  explicit long_system(equations<double_double> e) : equations(std::move(e)), unmoved_(pairs) {
    for (const long_pair& p : pairs) face_size.push_back(std::abs(p.face.hi));
  }

  /// The loads at the end of a step, from 1, valid until another step is asked for. Moves the faces of
  /// `pairs` to their places there; before the first call, they are as in the file.
  const long_loads& at_end_of(int step);

  const problem* what = nullptr;
  std::vector<double> face_size;  ///< sum of the magnitudes of the face's position and movement [pairs]
  std::vector<double> root;       ///< sqrt(K_ii), rounded up [dofs]
  std::vector<char> deflects;     ///< 1: a deflection, 0: a slope [dofs]
  /// The smallest product in the element formulas: the cube of a length, or a stiffness.
  double least_product = 1.0;
  /// The moments and shears in elements under displacements u [dofs] at the end of a step, from 1.
  std::function<std::vector<element_value>(int step, std::span<const double_double> u)> element_values;

  /// Adds K u to `sum`, and sum_j sqrt(K_ii K_jj) |u_j| to sizes_i unless `sizes` is empty. All [dofs].
  void add_product(std::span<const double_double> u, std::span<double_double> sum,
                   std::span<double> sizes = {}) const;

  /// The depth of a pair beyond its face under displacements u.
  [[nodiscard]] double_double depth(std::size_t pair, std::span<const double_double> u) const {
    return depth_of(pairs[pair], pairs[pair].seen_in(u));
  }
  /// A bound on the rounding of the depth.
  [[nodiscard]] double doubt(std::size_t pair, std::span<const double_double> u) const;
  /// The sum of the magnitudes from which the depth is computed.
  [[nodiscard]] double size_of_depth(std::size_t pair, std::span<const double_double> u) const {
    const long_pair& p = pairs[pair];
    return std::abs(u[p.dof].hi) + (p.other < 0 ? 0.0 : std::abs(u[p.other].hi)) + face_size[pair];
  }

  /// The residual f - K u - sum of n k max(0, d) over all pairs, whatever their statuses. f: the load; n, k,
  /// d: surface, stiffness and depth beyond the face of a pair.
  [[nodiscard]] long_residual residual(std::span<const double_double> u, const long_loads& l) const;
  /// The residual of u with the springs of the pairs in `closed`, ascending, which may pull, and no others.
  /// This residual is linear in u.
  [[nodiscard]] long_vector linear_residual(const long_residual& r, std::span<const double_double> u,
                                            const std::vector<int>& closed) const;
  /// The residual for a given long_residual::needed, each number of which was rounded once.
  [[nodiscard]] long_residual residual_of_rounded(long_vector needed) const;

  /// Sets `root`.
  void find_roots();

  /// True if a number of the equations that is not 0, or a product in the element formulas, is too small to
  /// have 32 digits.
  [[nodiscard]] bool is_below_range(const long_loads& l) const;
  /// True if no node is loaded or settles, and no pair is beyond its face at zero displacement. Loads inside
  /// elements may still act.
  [[nodiscard]] bool is_at_rest(const long_loads& l) const;

 private:
  void put_forces(long_residual& r) const;

  std::vector<long_pair> unmoved_;  // the pairs with their faces as in the file
  long_loads loads_;
};

/// The largest side of a structure; 0 for a matrix.
[[nodiscard]] double extent_of(const model& m);

/// `p` must outlive the result.
[[nodiscard]] long_system long_system_of(const problem& p);

}  // namespace contct
