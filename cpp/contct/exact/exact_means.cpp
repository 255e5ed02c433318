#include "contct/exact/exact_means.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "contct/exact/definite.hpp"
#include "contct/exact/path.hpp"
#include "contct/text/memory.hpp"

namespace contct::exact {
namespace {

using numeric::double_double;

vector exactly(const exact_problem& p, const exact_step& s, std::span<const double_double> u) {
  vector all;
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    all.push_back(p.fixed[dof] != 0
                      ? s.settlement[dof]
                      : rational(numeric::binary_value(u[dof].hi) + numeric::binary_value(u[dof].lo)));
  return all;
}

vector residual(const exact_problem& p, const exact_step& s, const vector& u) {
  vector needed(p.dofs());
  for (std::size_t dof = 0; dof < p.dofs(); ++dof) {
    needed[dof] = -s.load[dof];
    for (const auto& [column, k] : p.stiffness[dof]) needed[dof] += k * u[static_cast<std::size_t>(column)];
  }
  for (const exact_pair& c : p.pairs) {
    const auto dof = static_cast<std::size_t>(c.dof);
    const rational off = u[dof] - c.face;
    if (c.surface * off > 0) needed[dof] += c.stiffness * off;
  }
  return needed;
}

double_double rounded_twice(const rational& x) {
  const double high = numeric::rounded(x);
  if (!std::isfinite(high)) return high;  // no bound is proved by it
  return {high, numeric::rounded(rational(x - numeric::binary_value(high)))};
}

path::full_load_state state_of(const exact_step_end& end) {
  path::full_load_state s;
  s.from_exact_path = true;
  for (const rational& u : end.displacement) s.displacement.push_back(numeric::rounded(u));
  for (const char closed : end.closed) s.isep.push_back(closed != 0 ? in_contact : separated);
  return s;
}

/// A problem beside its path in doubles. It is converted, and its exact path followed, when that is first
/// asked for.
class problem_beside {
 public:
  explicit problem_beside(const problem& p) : what_(p) {}

  [[nodiscard]] path::found_end end_of(int step) {
    if (!path_) path_ = followed();
    const auto number = static_cast<std::size_t>(step) - 1;
    if (number >= path_->steps.size()) return {};
    const bool is_last = number + 1 == path_->steps.size();
    if (!is_last || path_->status == path_status::solved) return {state_of(path_->steps[number]), true};
    if (path_->status == path_status::mechanism) return {std::nullopt, false};
    return {};
  }

  [[nodiscard]] std::optional<std::vector<double_double>> residual_of(int step,
                                                                      std::span<const double_double> u) {
    std::optional<std::vector<double_double>> all;
    if (!converted() || !std::ranges::all_of(u, [](const double_double& x) { return std::isfinite(x.hi); }))
      return all;
    const exact_step& s = converted()->steps[static_cast<std::size_t>(step) - 1];
    all.emplace();
    for (const rational& x : residual(*converted(), s, exactly(*converted(), s, u)))
      all->push_back(rounded_twice(x));
    return all;
  }

  [[nodiscard]] std::optional<bool> is_semidefinite() {
    if (!converted()) return std::nullopt;
    try {
      const exact_problem& p = *converted();
      return !find_negative_work(p.stiffness, p.fixed, p.place, text::memory_limit());
    } catch (const std::runtime_error&) {  // it would take too many bits
      return std::nullopt;
    }
  }

 private:
  const std::optional<exact_problem>& converted() {
    if (!problem_) problem_ = small_exact_problem_of(what_);
    return *problem_;
  }

  exact_path followed() {
    try {
      return converted() ? follow_true_path(*converted()) : exact_path();
    } catch (const std::runtime_error&) {  // numbers are too long, or statuses cannot be decided
      return {};
    }
  }

  const problem& what_;
  std::optional<std::optional<exact_problem>> problem_;
  std::optional<exact_path> path_;
};

}  // namespace

int subdiagonals(const exact_problem& p) {
  int most = 0;
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    for (const auto& [column, k] : p.stiffness[dof])
      most = std::max(most, std::abs(p.place[dof] - p.place[static_cast<std::size_t>(column)]));
  return most;
}

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

certify::exact_means exact_means_of(const problem& p) {
  const auto beside = std::make_shared<problem_beside>(p);
  return {[beside](int step) { return beside->end_of(step); },
          [beside](int step, std::span<const double_double> u) { return beside->residual_of(step, u); },
          [beside] { return beside->is_semidefinite(); }};
}

}  // namespace contct::exact
