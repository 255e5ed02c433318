// Is the structure held? Decided by its rigid motions, not by a condition number.
#pragma once

#include <array>
#include <span>

#include "contct/rooms.hpp"

namespace contct::structure {

/// A body in space has six rigid motions.
inline constexpr int most_rigid_motions = 6;

/// What the rigid motions of a structure do at one dof: one number a motion, 0 for those it does not have. A
/// beam has two motions (up by 1; a turn about the middle that lifts its end by 1), a plate three (up, along
/// x, along y), a structure of which only the matrix is known up to six.
/// u = q0 row[0] + q1 row[1] + ... at every dof is a rigid motion.
using rigid_row = std::array<double, most_rigid_motions>;

/// What a motion q, one number for each rigid motion, does where `row` belongs.
[[nodiscard]] double along(const rigid_row& q, const rigid_row& row);

/// The largest magnitude in a row.
[[nodiscard]] double largest_of(const rigid_row& row);

/// How many independent rigid motions the dofs in `held` stop: the rank of their rows.
/// The structure is a mechanism when this is less than the number of its rigid motions.
class rigid_rank {
 public:
  /// Rows are scaled to the structure's size, so `independent` is a share of that size: two supports nearer
  /// to each other than 1e-12 of the length hold no better than one.
  explicit rigid_rank(double independent = 1e-12) : independent_(independent) {}

  /// Count one more dof as held.
  void hold(const rigid_row& row);
  [[nodiscard]] int rank() const { return rank_; }

  /// The part of a combination of motions that is still free.
  [[nodiscard]] rigid_row free_part(const rigid_row& motion) const;

 private:
  double independent_;
  std::array<rigid_row, most_rigid_motions> basis_{};  // orthonormal
  int rank_ = 0;
};

}  // namespace contct::structure
