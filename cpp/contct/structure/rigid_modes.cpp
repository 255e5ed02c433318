#include "contct/structure/rigid_modes.hpp"

#include <algorithm>
#include <cmath>

namespace contct {
namespace {

// Rows are scaled to the structure's size, so this is a share of that size: two supports nearer
// to each other than 1e-12 of the length hold no better than one.
constexpr double independent = 1e-12;

double dot(const rigid_row& a, const rigid_row& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

rigid_row rigid_rank::free_part(const rigid_row& motion) const {
  rigid_row rest = motion;
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough for Gram-Schmidt
    for (int k = 0; k < rank_; ++k) {
      const rigid_row& b = basis_[static_cast<std::size_t>(k)];
      const double along = dot(rest, b);
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= along * b[i];
    }
  }
  return rest;
}

void rigid_rank::hold(const rigid_row& row) {
  if (rank_ == 3) return;
  // Only its direction counts; a slope's row, 1 over a length, may be of any size.
  const double largest = std::max({std::abs(row[0]), std::abs(row[1]), std::abs(row[2])});
  if (!(largest > 0.0)) return;
  const rigid_row direction = {row[0] / largest, row[1] / largest, row[2] / largest};
  rigid_row rest = free_part(direction);
  const double left = std::sqrt(dot(rest, rest));
  if (!(left > independent * std::sqrt(dot(direction, direction)))) return;
  for (double& entry : rest) entry /= left;
  basis_[static_cast<std::size_t>(rank_++)] = rest;
}

}  // namespace contct
