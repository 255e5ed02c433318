// A random problem and its path under the corrected rule, certified at every step.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/path/solve_problem.hpp"
#include "support/beams.hpp"

namespace contct {

/// The observed increments of a path, and the certificates of its states.
struct followed {
  path_end end;
  recorder seen;
  std::vector<std::optional<certificate>> certificates;  // one for each step that ended
  std::size_t stride = 2;                                // dofs of a node; the deflection is the first

  [[nodiscard]] bool solved() const { return end.status == path_status::solved; }
  /// Returns true if the path is solved and its final state is unique.
  [[nodiscard]] bool determined() const { return solved() && certificates.back()->unique; }
  /// Returns the deflection of a node at the end of the last step.
  [[nodiscard]] double deflection(std::size_t node) const { return seen.steps.back().u[node * stride]; }
  [[nodiscard]] std::size_t nodes() const { return seen.steps.back().u.size() / stride; }
  /// Returns the largest deflection in any reported step.
  [[nodiscard]] double largest() const {
    double most = 0.0;
    for (const auto& step : seen.steps) {
      for (std::size_t dof = 0; dof < step.u.size(); dof += stride)
        most = std::max(most, std::abs(step.u[dof]));
    }
    return most;
  }
};

/// Follows `p` under the corrected rule. Final states are proved if `proved`, and otherwise remain as the
/// path reached them.
inline followed follow(const random_problem& p, bool proved = true) {
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  certifier certifies(p, s);
  followed f;
  f.stride = static_cast<std::size_t>(s.dofs_per_node);
  const path_limits limits{0, proved ? certifies.ends() : nullptr};
  f.end = follow(p, s, "refactor", *make_kernel("corrected"), {&f.seen, &certifies}, limits);
  f.certificates = certifies.steps();
  return f;
}

}  // namespace contct
