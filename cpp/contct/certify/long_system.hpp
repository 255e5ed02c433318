// A problem's equations in pairs of doubles, from the decimals that its file has, and how far rounding can
// put them off.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contct/model/equations.hpp"

namespace contct {

using long_vector = std::vector<double_double>;

/// Every entry of K is off by at most this share of sqrt(K_ii K_jj), every other number by this share of
/// itself: the element formulas take fewer than a hundred operations, each good to 2^-100 (double_double),
/// on decimals good to 2^-94.
inline constexpr double long_rounding = 0x1p-90;
/// Sums of doubles are off by less than this share of their magnitudes.
inline constexpr double summation_slack = 0x1p-30;

using long_pair = pair_in<double_double>;

/// The loads at the end of a step.
struct long_loads : loads_in<double_double> {
  int step = 0;  ///< at whose end they act, from 1; 0 in between
};

/// The residual of a step's loads in a state.
struct long_residual {
  long_vector force;          ///< 0 at fixed dofs [dofs]
  std::vector<double> slack;  ///< how far off that may be [dofs]
  long_vector needed;         ///< K u less the loads and what pairs press with, at every dof [dofs]
};

/// A value at the end of an element, in the order of element_results.
struct element_value {
  double_double value;
  double size = 0.0;    ///< the sum of the magnitudes that make it
  double energy = 0.0;  ///< |error| <= energy * rho, see reference/certificate-proof.md
  bool moment = true;   ///< otherwise a shear

  /// The largest rounding error of the value: a coordinate, a length or a modulus comes in at
  /// most ten times, each good to 2^-94.
  [[nodiscard]] double noise() const { return 4 * long_rounding * size; }
};

struct long_system : equations<double_double> {
  long_system() = default;
  explicit long_system(equations<double_double> e) : equations(std::move(e)), unmoved(pairs) {
    for (const long_pair& p : pairs) face_size.push_back(std::abs(p.face.hi));
  }

  std::vector<long_pair> unmoved;  ///< the pairs, with their faces where the file has them
  std::vector<double> face_size;   ///< [pairs] of the face and its move
  /// Puts the faces of `pairs` where these loads move them.
  void move_faces(const long_loads& l);

  std::vector<double> root;    ///< [dofs] sqrt(K_ii), rounded up
  std::vector<char> deflects;  ///< [dofs] 1: a deflection, 0: a slope
  double extent = 0.0;         ///< see extent_of
  /// The least that the formulas of its elements multiply: a cube of a length, a stiffness.
  double least_product = 1.0;
  /// Loads at the end of a step, from 1.
  std::function<long_loads(int step)> loads;
  /// The results in the elements under displacements u [dofs] at the end of a step.
  std::function<std::vector<element_value>(int step, std::span<const double_double> u)> element_values;

  /// sum += K u; and sizes_i += the sum of sqrt(K_ii K_jj) |u_j| over the entries of row i, unless `sizes` is
  /// empty. All [dofs].
  void add_product(std::span<const double_double> u, std::span<double_double> sum,
                   std::span<double> sizes = {}) const;

  /// The depth of a pair beyond its face under `u`, and the largest rounding error of that depth.
  [[nodiscard]] double_double depth(std::size_t pair, std::span<const double_double> u) const {
    return (pairs[pair].seen_in(u) - pairs[pair].face) * pairs[pair].surface;
  }
  [[nodiscard]] double doubt(std::size_t pair, std::span<const double_double> u) const;
  /// The magnitudes that it is summed from.
  [[nodiscard]] double size_of_depth(std::size_t pair, std::span<const double_double> u) const {
    const long_pair& p = pairs[pair];
    return std::abs(u[p.dof].hi) + (p.other < 0 ? 0.0 : std::abs(u[p.other].hi)) + face_size[pair];
  }

  /// The load minus K u and the forces of pairs beyond their faces, whatever their statuses.
  [[nodiscard]] long_residual residual(std::span<const double_double> u, const long_loads& l) const;
  /// The same, with one rounding of the forces that the elements need.
  [[nodiscard]] long_residual residual_of_rounded(long_vector needed) const;

  /// Are there numbers, or products of them in the element formulas, for which doubles are too coarse near 0?
  [[nodiscard]] bool is_below_range(const long_loads& l) const;
  /// Are there no loads, and no pairs beyond their faces at zero displacement?
  [[nodiscard]] bool is_unloaded(const long_loads& l) const;

 private:
  void put_forces(long_residual& r) const;
};

/// The largest side of a structure; 0 if it has none.
[[nodiscard]] double extent_of(const model& m);

/// `p` must outlive it.
[[nodiscard]] long_system long_system_of(const problem& p);

}  // namespace contct
