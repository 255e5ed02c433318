#include "contct/results/exact_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/exact_means.hpp"

namespace contct {
namespace {

void refuse_too_many_dofs(const problem& p, const std::string& file) {
  if (dofs(p.geometry) > most_exact_dofs)
    throw std::invalid_argument(
        fmt::format("{}: found {} dofs; allowed: at most {} in exact arithmetic, whose numbers grow with "
                    "the dofs. Use fewer elements",
                    file, dofs(p.geometry), most_exact_dofs));
}

/// Returns what `find` returns. Its exceptions become std::invalid_argument, with `name` before the message.
template <class Find>
auto naming(const std::string& name, const Find& find) {
  try {
    return find();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(fmt::format("{}: {}", name, e.what()));
  } catch (const std::runtime_error& e) {
    throw std::invalid_argument(fmt::format("{}: {}", name, e.what()));
  }
}

/// Refuses a matrix that is not positive semidefinite, which the equations of the path would not show.
/// Matrices of beams and plates are sums of semidefinite element matrices.
void refuse_indefinite(const assembled& a, const problem& of, const exact_problem& p) {
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    if (p.fixed[dof] == 0 && p.stiffness[dof].at(static_cast<int>(dof)) == 0)
      refuse_without_stiffness(a, static_cast<int>(dof));
  const definiteness found = naming(a.name, [&] { return definiteness_of(of, p); });
  if (found.semidefinite) return;
  if (!found.shown)
    throw std::invalid_argument(
        fmt::format("{}: 32 digits do not decide whether the matrix is positive semidefinite", a.name));
  const rational_vector& motion = found.shown->motion;
  const auto largest =
      std::ranges::max_element(motion, [](const rational& x, const rational& y) { return abs(x) < abs(y); });
  const rational size = abs(*largest);
  throw std::invalid_argument(fmt::format(
      "{}: not positive semidefinite: found u'Ku = {}, exactly, for a displacement u whose largest component "
      "is "
      "1, at dof {}; allowed: 0 or more for every u that the supports allow. Rounded entries can cause this, "
      "as in the matrix of a body without supports",
      a.name, short_words(found.shown->work / (size * size), 6),
      a.label_of(static_cast<int>(largest - motion.begin()))));
}

/// Changes `mechanism` in a path of the 1989 rule to `path_ended` if the corrected path has an equilibrium.
void tell_mechanisms(exact_path& path, const exact_problem& p) {
  if (std::ranges::count(path.steps, path_status::mechanism, &exact_step_end::status) == 0) return;
  const exact_path corrected = follow_corrected_path(p);
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    exact_step_end& s = path.steps[i];
    const path_status truly = i < corrected.steps.size() ? corrected.steps[i].status : corrected.status();
    if (s.status == path_status::mechanism && truly != path_status::mechanism)
      s.status = path_status::path_ended;
  }
}

exact_problem exactly_read(const problem& p, const std::string& file) {
  refuse_too_many_dofs(p, file);
  exact_problem e = naming(file, [&] { return exact_problem_of(p); });
  if (const auto* const a = std::get_if<assembled>(&p.geometry.kind)) refuse_indefinite(*a, p, e);
  return e;
}

exact_path follow_exactly(const exact_problem& p, const std::string& rule, const std::string& file,
                          const exact_progress& tell) {
  return naming(file, [&] {
    try {
      if (rule != "1989") return follow_corrected_path(p, tell);
      exact_path path = follow_1989_path(p, tell);
      tell_mechanisms(path, p);
      return path;
    } catch (const too_long& e) {
      throw std::invalid_argument(
          fmt::format("exact numbers became too long: found {}; allowed: at most {} bits. Use numbers with "
                      "fewer digits, or fewer elements",
                      e.what(), p.longest));
    }
  });
}

}  // namespace

exact_run run_exactly(const problem& p, const std::string& file, const std::string& rule,
                      const std::vector<std::string>& kernels, const exact_progress& tell, observer* shown) {
  exact_run run{p, exactly_read(p, file), {}, {}};
  run.path = follow_exactly(run.exactly, rule, file, tell);
  if (kernels.empty()) return run;
  const linear_structure structure = structure_of(p);
  for (const std::string& name : kernels) {
    const double rounding = facts_of_kernel(name).real_bytes == 4 ? 1e-4 : 1e-9;  // of shares
    run.kernels.push_back(digits_on(path_of(name, p, structure, "", shown), name, p, run.path, rounding));
  }
  return run;
}

}  // namespace contct
