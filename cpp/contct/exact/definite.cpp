#include "contct/exact/definite.hpp"

#include <vector>

#include "contct/certify/scaled_stiffness.hpp"

namespace contct {
namespace {

/// None where K does no negative work on the displacement.
std::optional<negative_work> work_on(const std::vector<double>& motion, const exact_problem& p) {
  negative_work w;
  for (const double x : motion) w.motion.push_back(binary_value(x));
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    for (const auto& [column, k] : p.stiffness[dof]) w.work += w.motion[dof] * k * w.motion[column];
  return w.work < 0 ? std::optional(std::move(w)) : std::nullopt;
}

}  // namespace

definiteness definiteness_of(const problem& p, const exact_problem& exactly) {
  lifted_solver pivots(exactly.stiffness, exactly.fixed, exactly.place);
  pivots.factor({});
  long_system on_pivots = long_system_of(p);
  for (std::size_t dof = 0; dof < exactly.dofs(); ++dof)
    if (!pivots.has_pivot(dof)) on_pivots.fixed[dof] = 1;
  scaled_stiffness k(on_pivots, exactly.place, subdiagonals(exactly));
  if (k.factor({}) && k.least_eigenvalue() > 0.0) return {true};
  return {false, work_on(k.suspect(), exactly)};
}

}  // namespace contct
