#include "contct/exact/exact_residual.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "contct/exact/definite.hpp"
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
    for (const auto& [column, k] : p.stiffness[dof]) needed[dof] += k * u[column];
  }
  for (const exact_pair& c : p.pairs) {
    const rational off = u[c.dof] - c.face;
    if (c.surface * off > 0) needed[c.dof] += c.stiffness * off;
  }
  return needed;
}

}  // namespace

std::optional<exact_problem> small_exact_problem_of(const problem& p) {
  if (dofs(p.geometry) > most_dofs_beside_doubles ||
      subdiagonals(p.geometry) > most_subdiagonals_beside_doubles)
    return std::nullopt;
  try {
    return exact_problem_of(p);
  } catch (const std::runtime_error&) {  // a number is too long
    return std::nullopt;
  }
}

std::function<std::optional<std::vector<double_double>>(int, std::span<const double_double>)>
exact_residual_of(const problem& p) {
  return [&p, made = std::shared_ptr<const std::optional<exact_problem>>()](
             int step, std::span<const double_double> u) mutable {
    if (!made) made = std::make_shared<const std::optional<exact_problem>>(small_exact_problem_of(p));
    std::optional<std::vector<double_double>> all;
    if (!*made || !std::ranges::all_of(u, [](const double_double& x) { return std::isfinite(x.hi); }))
      return all;
    const exact_problem& exact = **made;
    const exact_step& s = exact.steps[step - 1];
    all.emplace();
    for (const rational& x : residual(exact, s, exactly(exact, s, u)))
      all->push_back(numeric::long_rounded(x));
    return all;
  };
}

std::function<std::optional<bool>()> semidefinite_test_of(const problem& p) {
  return [&p]() -> std::optional<bool> {
    const std::optional<exact_problem> exactly = small_exact_problem_of(p);
    if (!exactly) return std::nullopt;
    try {
      return !find_negative_work(exactly->stiffness, exactly->fixed, exactly->place, text::memory_limit());
    } catch (const std::runtime_error&) {  // it would take too many bits
      return std::nullopt;
    }
  };
}

}  // namespace contct::exact
