// Is the structure held? Decided by its rigid-body motions, not by a condition number. Of beams and plates
// they are known, in rational numbers from the decimals of the file: rounding must not decide which are
// stopped, and what loads do on them. Where only the stiffness matrix is known, they are found from that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

struct beam;
struct contact_pair;
struct load;
struct plate;
struct resultant;
class rigid_truth;

/// A body in space has six rigid-body motions.
inline constexpr int most_rigid_motions = 6;

/// What the rigid-body motions of a structure do at one dof: one number a motion, 0 for those it does not
/// have. A beam has two motions (up by 1; a turn about the middle that lifts its end by 1) and one for each
/// hinge (a turn of what is right of it by as much; here of the first four), a plate three (up, along x,
/// along y), a structure of which only the matrix is known up to six. u = q0 row[0] + q1 row[1] + ... at
/// every dof is a rigid-body motion.
using rigid_row = std::array<double, most_rigid_motions>;

/// The displacement by a motion q, one number for each rigid-body motion, at the dof of `row`.
[[nodiscard]] inline double along(const rigid_row& q, const rigid_row& row) {
  return std::inner_product(q.begin(), q.end(), row.begin(), 0.0);
}

/// The largest magnitude in a row.
[[nodiscard]] inline double largest_of(const rigid_row& row) {
  double largest = 0.0;
  for (const double entry : row) largest = std::max(largest, std::abs(entry));
  return largest;
}

/// How many independent rigid-body motions the dofs that are held stop: the rank of their rows.
/// The structure is a mechanism when this is less than the number of its rigid-body motions.
class rigid_rank {
 public:
  /// `rows` of all dofs, which are found from a matrix and rounded: a row is independent if its part
  /// orthogonal to the others is larger than this share of it. They must outlive this object, as `truth`
  /// must.
  rigid_rank(std::span<const rigid_row> rows, double independent) : rows_(rows), independent_(independent) {}
  /// By rows that `truth` knows exactly.
  explicit rigid_rank(const rigid_truth& truth) : truth_(&truth) {}

  /// Count a dof as held; or, of rows of a matrix, its distance to another one, if that is not negative.
  void hold(int dof, int other = -1);

  [[nodiscard]] int rank() const { return rank_; }

  /// Independent held dofs that stop every motion that any held dof stops.
  [[nodiscard]] std::span<const int> dofs() const { return dofs_; }

  /// The part of a combination of rigid-body motions that is still free; for the rows of a matrix.
  [[nodiscard]] rigid_row free_part(const rigid_row& motion) const;

 private:
  std::span<const rigid_row> rows_;
  double independent_ = 0.0;
  const rigid_truth* truth_ = nullptr;
  std::array<rigid_row, most_rigid_motions> basis_{};  // orthonormal up to rounding; of rows of a matrix
  std::vector<int> dofs_;                              // [rank_]
  int rank_ = 0;
};

/// With its diagonal scaled to 1, which removes the units, a stiffness matrix has eigenvalues between 0 and
/// a few. One up to this size may count as 0, and its motion as free, where the matrix does not say better.
inline constexpr double free_below = 1e-13;
/// A matrix with one below minus this is refused as not positive semidefinite.
inline constexpr double negative_beyond = 1e-10;

struct free_motions {
  int count = 0;
  std::vector<rigid_row> rows;  ///< [rows of the matrix] the displacement by each motion there
  double rounding = 0.0;        ///< how far off these may be, relative
};

/// Find them in `k`, whose diagonal is positive. `known`: how many there are, where that is known; they must
/// then be free to 1e-10. `doubt`: by how much u'K u is in doubt for u [rows]; a soft motion is stiffness,
/// and not free, where there is less doubt than stiffness. Takes a factorisation, and up to three times that
/// and some forty solves where the matrix is close to leaving something free; memory for K once more and a
/// factor.
///
/// Throws std::invalid_argument when k has a negative eigenvalue, leaves more than six rigid-body motions, or
/// fewer than `known`; the message calls it "the matrix".
[[nodiscard]] free_motions find_free_motions(
    const stiffness_matrix& k, std::optional<int> known,
    const std::function<double(std::span<const double> u)>& doubt = nullptr);

/// The displacements by the rigid-body motions of a beam or plate at its dofs [dofs], in doubles.
template <class Kind>
[[nodiscard]] std::vector<rigid_row> rigid_rows_of(const Kind& kind);

/// The work of a load on each rigid-body motion of a beam or plate, exactly; or nothing, if unknown.
class rigid_work {
 public:
  struct numbers;
  rigid_work() = default;
  explicit rigid_work(std::shared_ptr<const numbers> exactly) : exactly_(std::move(exactly)) {}

  [[nodiscard]] bool is_known() const { return exactly_ != nullptr; }
  [[nodiscard]] const numbers& exactly() const { return *exactly_; }
  /// This work less another; not known where one of them is not.
  [[nodiscard]] rigid_work less(const rigid_work& other) const;

 private:
  std::shared_ptr<const numbers> exactly_;
};

/// A rigid-body motion, scaled so that the largest of its parts is 1.
struct free_motion {
  std::function<double(int dof)> at;  ///< the displacement of a dof; 0 if the dof rests
  double work;                        ///< the work of the load on it, positive
};

/// The rigid-body motions of a beam or plate: up by 1, and turns about its middle that lift an end by 1. A
/// beam with hinges has one for each of these and of its ends instead, which lifts it by 1 and leaves the
/// others.
class rigid_truth {
 public:
  explicit rigid_truth(const beam& b);
  explicit rigid_truth(const plate& p);

  /// The number of motions.
  [[nodiscard]] int motions() const;

  /// Does dof `dof`, held, stop a motion that the dofs of `held` do not? These are independent of each other.
  [[nodiscard]] bool is_independent(std::span<const int> held, int dof) const;

  /// The work of `l`; its settlements of fixed dofs do no work.
  [[nodiscard]] rigid_work work_of(const load& l) const;

  /// See resultant_of.
  [[nodiscard]] resultant resultant_of(const load& l) const;

  /// The steepest of the motions that the dofs of `held`, independent of each other, leave free; nothing if
  /// `work`, which must be known, is 0 on all of them. `rows`: rigid_rows_of the structure, which the motion
  /// refers to.
  [[nodiscard]] std::optional<free_motion> driven_by(const rigid_work& work, std::span<const int> held,
                                                     std::span<const rigid_row> rows) const;

  /// Is there an equilibrium under a load of this `work`, which is known: do forces of the supports of
  /// `supported`, and of pairs that press, balance it? The energy of a structure is otherwise without a least
  /// value: some rigid-body motion that no pair and no support stops does work.
  [[nodiscard]] bool is_carried(const rigid_work& work, std::span<const int> supported,
                                std::span<const contact_pair> pairs) const;

 private:
  struct shape;
  std::shared_ptr<const shape> shape_;
};

}  // namespace contct
