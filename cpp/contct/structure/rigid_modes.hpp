// Rigid-body motions and their rank, which decides whether a structure is held; a condition number does not.
// The motions of beams and plates are rational numbers, computed from the decimals of the file, because
// rounding must not decide which motions are stopped. The motions of a matrix are computed from K.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "contct/linear/stiffness_matrix.hpp"

namespace contct {

struct beam;
struct load;
template <class Number>
struct pair_in;
struct plate;
struct resultant;
class rigid_truth;

/// A body in space has six rigid-body motions.
inline constexpr int most_rigid_motions = 6;

/// The displacement of one dof by each rigid-body motion; 0 for motions that the structure does not have.
/// With any factors q, the displacements u = q0 row[0] + q1 row[1] + ... of all dofs are a rigid-body motion.
/// A beam has two motions: up by 1, and a turn about the middle that lifts the right end by 1. A beam with
/// hinges: the first six motions of rigid_truth. A plate has three: up by 1, a turn along x, a turn along y.
/// A matrix has up to six.
using rigid_row = std::array<double, most_rigid_motions>;

/// The displacement, at the dof that has this `row`, by the sum of q[i] times rigid-body motion i.
[[nodiscard]] inline double along(const rigid_row& q, const rigid_row& row) {
  return std::inner_product(q.begin(), q.end(), row.begin(), 0.0);
}

[[nodiscard]] inline double largest_of(const rigid_row& row) {
  double largest = 0.0;
  for (const double entry : row) largest = std::max(largest, std::abs(entry));
  return largest;
}

/// The number of independent rigid-body motions that the held dofs stop: the rank of the rows of these dofs.
/// The structure is a mechanism if the rank is less than the number of its rigid-body motions.
class rigid_rank {
 public:
  /// From rounded `rows` [dofs], as for a matrix; `rows` must outlive this object. A row is independent if
  /// the part of the row that is orthogonal to all held rows is larger than `independent` times the row.
  rigid_rank(std::span<const rigid_row> rows, double independent) : rows_(rows), independent_(independent) {}
  /// From the exact rows of `truth`, for a beam or plate; `truth` must outlive this object.
  explicit rigid_rank(const rigid_truth& truth) : truth_(&truth) {}

  /// Counts `dof` as held. For a matrix, if `other` >= 0: counts the difference of `dof` and `other` as held.
  void hold(int dof, int other = -1);

  [[nodiscard]] int rank() const { return rank_; }

  /// A maximal independent subset of the held dofs.
  [[nodiscard]] std::span<const int> dofs() const { return dofs_; }

  /// The part of the combination `motion` that the held dofs leave free. Only for a rank made from `rows`.
  [[nodiscard]] rigid_row free_part(const rigid_row& motion) const;

 private:
  std::span<const rigid_row> rows_;
  double independent_ = 0.0;
  const rigid_truth* truth_ = nullptr;
  std::array<rigid_row, most_rigid_motions> basis_{};  // orthonormal up to rounding; not with `truth`
  std::vector<int> dofs_;                              // [rank_]
  int rank_ = 0;
};

/// A stiffness matrix whose diagonal is scaled to 1 has no units, and its eigenvalues are of the order of 1
/// or smaller. An eigenvalue up to free_below counts as 0, and its eigenvector as a rigid-body motion, unless
/// larger eigenvalues are near and it exceeds the uncertainty of the matrix.
inline constexpr double free_below = 1e-13;
/// A matrix is refused as not positive semidefinite if an eigenvalue after this scaling is below
/// -negative_beyond.
inline constexpr double negative_beyond = 1e-10;

struct free_motions {
  int count = 0;
  std::vector<rigid_row> rows;  ///< [rows of the matrix] the displacements by the `count` rigid-body motions
  double rounding = 0.0;        ///< the largest relative error of `rows`
  double stiffness = 0.0;       ///< the eigenvalue of the motions with the largest magnitude
};

/// Finds the rigid-body motions of `k`, whose diagonal is positive. `known`: the number of motions, if known;
/// their eigenvalues must then be at most 1e-10, or 1e-4 in magnitude and far below the others. `doubt`: the
/// uncertainty of u'K u for u [rows]. Takes one factorisation; if `k` is nearly singular, up to three times
/// as long, and some forty solves. Memory: a copy of K, and a factor.
///
/// Throws std::invalid_argument if `k` has a negative eigenvalue, or more than six rigid-body motions, or
/// fewer than `known`; the message calls `k` "the matrix".
[[nodiscard]] free_motions find_free_motions(
    const stiffness_matrix& k, std::optional<int> known,
    const std::function<double(std::span<const double> u)>& doubt = nullptr);

/// [dofs] the displacements by the rigid-body motions of a beam or plate, in doubles.
template <class Kind>
[[nodiscard]] std::vector<rigid_row> rigid_rows_of(const Kind& kind);

/// The exact work of a load on each rigid-body motion of a beam or plate; null if it is unknown.
struct rigid_numbers;
using rigid_work = std::shared_ptr<const rigid_numbers>;
/// `work` minus `other`; unknown if either is unknown.
[[nodiscard]] rigid_work difference_of(const rigid_work& work, const rigid_work& other);

/// A combination of rigid-body motions; the largest factor is 1 in magnitude.
struct free_motion {
  std::function<double(int dof)> at;  ///< the displacement of `dof`; 0 if the dof does not move
  double work;                        ///< the work of the load on the motion, positive
};

/// The exact rigid-body motions of a beam or plate: up by 1, and turns about the middle that lift the end at
/// the largest x, or y, by 1. A beam with hinges has instead one motion for each end and each hinge, which
/// lifts this point by 1 and none of the other ends and hinges.
class rigid_truth {
 public:
  explicit rigid_truth(const beam& b);
  explicit rigid_truth(const plate& p);

  [[nodiscard]] int motions() const;

  /// True if holding `dof` stops a motion that the dofs in `held`, whose rows are independent, leave free.
  [[nodiscard]] bool is_independent(std::span<const int> held, int dof) const;

  /// The work of `l` on each motion. Prescribed displacements do no work.
  [[nodiscard]] rigid_work work_of(const load& l) const;

  [[nodiscard]] resultant resultant_of(const load& l) const;

  /// The motion in the direction in which the work grows fastest, among the motions that the dofs in `held`
  /// leave free. Nothing if `work`, which must be known, is 0 on all these motions. `rows`: rigid_rows_of the
  /// structure, which must outlive the returned motion.
  [[nodiscard]] std::optional<free_motion> driven_by(const rigid_work& work, std::span<const int> held,
                                                     std::span<const rigid_row> rows) const;

  /// True if there is an equilibrium: if forces of the supports at the dofs `supported` and contact forces of
  /// `pairs` can balance a load that does `work`, which must be known. Otherwise the load does work on a
  /// rigid-body motion that neither a support nor a pair stops.
  [[nodiscard]] bool is_carried(const rigid_work& work, std::span<const int> supported,
                                std::span<const pair_in<double>> pairs) const;

 private:
  struct shape;
  std::shared_ptr<const shape> shape_;
};

}  // namespace contct
