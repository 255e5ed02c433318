#include "contct/proof/exact_means.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "contct/proof/scaled_stiffness.hpp"

namespace contct {
namespace {

rational_vector exactly(const exact_problem& p, const exact_step& s, std::span<const double_double> u) {
  rational_vector all;
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    all.push_back(p.fixed[dof] != 0 ? s.settlement[dof]
                                    : rational(binary_value(u[dof].hi) + binary_value(u[dof].lo)));
  return all;
}

solved_step state_of(int step, const exact_step_end& end) {
  solved_step s{{.step = step, .fraction = 1.0, .isep = end.isep, .from = origin::exact_path}, end.status};
  for (const rational& u : end.displacement) s.displacement.push_back(contct::rounded(u));
  return s;
}

/// The motion and the work of K on it, if this work is negative.
std::optional<negative_work> work_on(const std::vector<double>& motion, const exact_problem& p) {
  negative_work w;
  for (const double x : motion) w.motion.push_back(binary_value(x));
  for (std::size_t dof = 0; dof < p.dofs(); ++dof) w.work += w.motion[dof] * p.add_row(dof, w.motion, 0);
  return w.work < 0 ? std::optional(std::move(w)) : std::nullopt;
}

/// Converts a problem to rational numbers; empty if it exceeds the limits in exact_means.hpp.
std::optional<exact_problem> small_exact_problem_of(const problem& p) {
  if (dofs(p.geometry) > most_dofs_beside_doubles) return std::nullopt;
  try {
    std::optional<exact_problem> exactly = exact_problem_of(p);
    if (subdiagonals(*exactly) > most_subdiagonals_beside_doubles) return std::nullopt;
    exactly->longest = most_bits_beside_doubles;
    return exactly;
  } catch (const std::runtime_error&) {  // a number is too long
    return std::nullopt;
  }
}

/// Converts the problem and follows its exact path at the first request.
class problem_beside final : public exact_means {
 public:
  explicit problem_beside(const problem& p) : what_(p) {}

  [[nodiscard]] solved_step end_of(int step) override {
    if (step > std::ssize(what_.steps)) return {};
    const auto [first, last] = chain_of(static_cast<std::size_t>(step) - 1);
    if (!path_ || first_ != first) path_ = followed(first, last);
    first_ = first;
    const std::size_t at = static_cast<std::size_t>(step) - 1 - first;
    if (at >= path_->steps.size()) return {};
    return state_of(step, path_->steps[at]);
  }

  [[nodiscard]] std::optional<long_vector> residual_of(int step, std::span<const double_double> u) override {
    if (!converted() || !std::ranges::all_of(u, [](const double_double& x) { return std::isfinite(x.hi); }))
      return std::nullopt;
    const exact_step& s = converted()->steps[step - 1];
    long_vector all;
    for (const rational& x : converted()->needed(exactly(*converted(), s, u), s))
      all.push_back(long_rounded(x));  // infinite beyond the range of doubles; nothing is then proved
    return all;
  }

  [[nodiscard]] bool is_semidefinite() override {
    try {
      return converted() && definiteness_of(what_, *converted()).semidefinite;
    } catch (const std::runtime_error&) {  // K is indefinite, or numbers are too long
      return false;
    }
  }

 private:
  const std::optional<exact_problem>& converted() {
    if (!problem_) problem_ = small_exact_problem_of(what_);
    return *problem_;
  }

  /// The first step of the chain that contains `step`, and the step after the last step of this chain. Each
  /// step of a chain, except the first, starts from the end of the step before.
  [[nodiscard]] std::pair<std::size_t, std::size_t> chain_of(std::size_t step) const {
    std::size_t first = step;
    while (first > 0 && !what_.steps[first].from_zero) --first;
    std::size_t last = step + 1;
    while (last < what_.steps.size() && !what_.steps[last].from_zero) ++last;
    return {first, last};
  }

  exact_path followed(std::size_t first, std::size_t last) {
    try {
      if (!converted()) return {};
      exact_problem chain = *converted();
      chain.steps.assign(converted()->steps.begin() + static_cast<std::ptrdiff_t>(first),
                         converted()->steps.begin() + static_cast<std::ptrdiff_t>(last));
      return follow_corrected_path(chain);
    } catch (const std::runtime_error&) {  // numbers are too long, or statuses cannot be decided
      return {};
    }
  }

  const problem& what_;
  std::optional<std::optional<exact_problem>> problem_;
  std::optional<exact_path> path_;  // path of the chain that starts with step first_, from 0
  std::size_t first_ = 0;
};

}  // namespace

definiteness definiteness_of(const problem& p, const exact_problem& exactly) {
  lifted_solver pivots(exactly.stiffness, exactly.fixed, exactly.place);
  pivots.factor({});
  long_system on_pivots = long_system_of(p);
  for (std::size_t dof = 0; dof < exactly.dofs(); ++dof)
    if (!pivots.has_pivot(dof)) on_pivots.fixed[dof] = 1;
  scaled_stiffness k(on_pivots, exactly.place, subdiagonals(exactly));
  if (k.factor({}) && k.least_eigenvalue() > 0.0) return {true};
  return {false, work_on(k.doubtful_motion(), exactly)};
}

std::unique_ptr<exact_means> exact_means_of(const problem& p) {
  return std::make_unique<problem_beside>(p);
}

}  // namespace contct
