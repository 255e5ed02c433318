#include "contct/path/rigid_snap.hpp"

#include <algorithm>
#include <cmath>

#include "contct/kernel/call.hpp"

namespace contct::path {
namespace {

constexpr double rounding_of_work = 1e-12;
constexpr double rounding_of_motion = 1e-10;

/// The free motion on which the load does most work, its largest part 1; all zero when it does none.
rigid_row driven_motion(const linear_structure& s, std::span<const int> status,
                        std::span<const double> increment) {
  rigid_rank rank = s.nothing_held();
  for (const rigid_row& row : s.held_by_supports) rank.hold(row);
  for (std::size_t i = 0; i < status.size(); ++i) {
    if (status[i] == in_contact) rank.hold(s.held_by_pairs[i]);
  }
  rigid_row work{};
  rigid_row size{};
  for (std::size_t dof = 0; dof < increment.size(); ++dof) {
    if (s.fixed[dof] != 0) continue;
    for (std::size_t m = 0; m < work.size(); ++m) {
      work[m] += increment[dof] * s.rigid_rows[dof][m];
      size[m] += std::abs(increment[dof] * s.rigid_rows[dof][m]);
    }
  }
  rigid_row motion = rank.free_part(work);
  const double driven = largest_of(motion);
  if (!(driven > std::max(rounding_of_work, s.rigid_rounding) * largest_of(size))) return {};
  for (double& part : motion) part /= driven;
  return motion;
}

}  // namespace

bool rigid_snap(const linear_structure& s, std::span<const int> status, std::span<const double> increment,
                std::span<const double> d, std::span<double> d_star) {
  const rigid_row motion = driven_motion(s, status, increment);
  if (largest_of(motion) == 0.0) return false;
  const double still = std::max(rounding_of_motion, s.rigid_rounding);
  double longest_way = 0.0;
  for (std::size_t i = 0; i < status.size(); ++i) {
    d_star[i] = along(motion, s.held_by_pairs[i]);
    if (status[i] == in_contact || std::abs(d_star[i]) < still) continue;
    longest_way = std::max(longest_way, (s.pairs[i].face - d[i]) / d_star[i]);
  }
  for (std::size_t i = 0; i < status.size(); ++i) {
    d_star[i] = along(motion, s.held_by_pairs[i]) * (longest_way > 0.0 ? 2.0 * longest_way : 1.0);
  }
  for (std::size_t i = 0; i < status.size(); ++i) {  // what is left there is rounding
    if (status[i] == in_contact) d_star[i] = 0.0;
  }
  return true;
}

}  // namespace contct::path
