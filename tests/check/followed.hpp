// A random problem and its path under the corrected rule, certified at every step.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "contct/check/certificate.hpp"
#include "contct/check/random_problem.hpp"
#include "contct/path/follow.hpp"
#include "path/beams.hpp"

namespace contct {

/// What happened on a path.
struct followed {
  path_end end;
  recorder seen;
  std::vector<std::optional<certificate>> certificates;  // one for each step that ended
  bool last_has_equilibrium = true;                      // the last step reached, by the oracle

  /// The last load of the problem was applied in full.
  [[nodiscard]] bool solved() const { return end.status == path_status::solved; }
  [[nodiscard]] bool all_exact() const {
    for (const auto& c : certificates) {
      if (!c || !c->exact) return false;
    }
    return true;
  }
  [[nodiscard]] const std::vector<double>& last() const { return seen.steps.back().u; }
};

/// Follow `p` under the kernel of that name. With `rescue`, the oracle helps where the path cannot go on.
inline followed follow(const random_problem& p, const char* kernel = "corrected", bool rescue = true) {
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  certifier certifies(s, [&p](int step, std::span<double> f) {
    add_consistent_loads(p.geometry, p.steps[static_cast<std::size_t>(step - 1)], f);
  });
  oracle helper(s);
  path_limits limits;
  if (rescue) {
    limits.rescue = [&helper](std::span<const double> load) -> std::optional<rest_state> {
      const oracle_answer a = helper.solve(load);
      if (a.how != oracle_answer::outcome::found) return {};
      return rest_state{a.displacement, a.pressed};
    };
  }
  followed f;
  observer* const observers[] = {&f.seen, &certifies};
  f.end = follow_steps(p.geometry, s, p.steps, "refactor", *make_kernel(kernel), observers, limits);
  f.certificates = certifies.steps();
  if (!f.solved()) {
    std::vector<double> load(static_cast<std::size_t>(s.dofs()), 0.0);
    add_consistent_loads(p.geometry, p.steps[static_cast<std::size_t>(f.end.step - 1)], load);
    f.last_has_equilibrium = oracle(s).solve(load).how != oracle_answer::outcome::no_equilibrium;
  }
  return f;
}

/// The largest deflection that any step told.
inline double largest_deflection(const followed& f) {
  double largest = 0.0;
  for (const auto& step : f.seen.steps) {
    for (std::size_t dof = 0; dof < step.u.size(); dof += 2)
      largest = std::max(largest, std::abs(step.u[dof]));
  }
  return largest;
}

/// The tolerance of the last certificate.
inline double last_tolerance(const followed& f) {
  return f.certificates.back() ? f.certificates.back()->tolerance : 0.0;
}

}  // namespace contct
