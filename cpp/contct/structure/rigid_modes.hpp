// Is the structure held? Decided by its rigid motions, not by a condition number.
#pragma once

#include <array>
#include <span>

namespace contct {

/// What the rigid motions of a structure do at one dof: one number a motion. A beam has two motions
/// (up by 1; a turn about the middle that lifts its end by 1), a plate three (up, along x, along y).
/// u = q0 row[0] + q1 row[1] + q2 row[2] at every dof is a rigid motion.
using rigid_row = std::array<double, 3>;

/// How many independent rigid motions the dofs in `held` stop: the rank of their rows.
/// The structure is a mechanism when this is less than the number of its rigid motions.
class rigid_rank {
 public:
  /// Count one more dof as held.
  void hold(const rigid_row& row);
  [[nodiscard]] int rank() const { return rank_; }

  /// The part of a combination of motions that nothing held so far stops.
  [[nodiscard]] rigid_row free_part(const rigid_row& motion) const;

 private:
  std::array<rigid_row, 3> basis_{};  // orthonormal
  int rank_ = 0;
};

}  // namespace contct
