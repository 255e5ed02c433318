#include "contct/structure/rigid_modes.hpp"

#include <algorithm>
#include <cmath>

namespace contct::structure {

double along(const rigid_row& q, const rigid_row& row) {
  double sum = q[0] * row[0];
  for (std::size_t i = 1; i < row.size(); ++i) sum += q[i] * row[i];
  return sum;
}

double largest_of(const rigid_row& row) {
  double largest = 0.0;
  for (const double entry : row) largest = std::max(largest, std::abs(entry));
  return largest;
}

rigid_row rigid_rank::free_part(const rigid_row& motion) const {
  rigid_row rest = motion;
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough for Gram-Schmidt
    for (int k = 0; k < rank_; ++k) {
      const rigid_row& b = basis_[k];
      const double share = along(rest, b);
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= share * b[i];
    }
  }
  return rest;
}

void rigid_rank::hold(const rigid_row& row) {
  if (rank_ == most_rigid_motions) return;
  // Only its direction counts; a slope's row, 1 over a length, may be of any size.
  const double largest = largest_of(row);
  if (!(largest > 0.0)) return;
  rigid_row direction = row;
  for (double& entry : direction) entry /= largest;
  rigid_row rest = free_part(direction);
  const double left = std::sqrt(along(rest, rest));
  if (!(left > independent_ * std::sqrt(along(direction, direction)))) return;
  for (double& entry : rest) entry /= left;
  basis_[rank_++] = rest;
}

}  // namespace contct::structure
