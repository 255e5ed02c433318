// contct exact: the path in rational arithmetic, and how many digits of each kernel are right.
#include <algorithm>
#include <optional>
#include <stdexcept>

#include "app/problem_runs.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/exact/definite.hpp"
#include "contct/exact/demand.hpp"
#include "contct/exact/exact_problem.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/text/memory.hpp"
#include "contct/write/exact_output.hpp"

namespace contct::app {
namespace {

/// The kernel's own path beside the exact one.
kernel_digits digits_of_kernel(const std::string& name, const problem& p, const linear_structure& s,
                               const exact_path& exactly, path_progress& shown) {
  constexpr double rounding[] = {1e-9, 1e-4};  // of an event's share, in 8 and in 4 bytes
  const std::unique_ptr<kernel> leader = make_kernel(name);
  digit_counter counter(p, exactly);
  const path_end end = follow(p, s, "refactor", *leader, {shown.before.get(), &counter, shown.behind.get()},
                              {0, fallback_to_reference(s, loads_of(p, s))});
  shown.line.erase();
  return counter.result(name, end.status, rounding[leader->facts().real_bytes == 4 ? 1 : 0]);
}

/// A problem that would take more than a machine has is refused before it is converted.
void refuse_too_large(const problem& p, const std::string& file) {
  if (dofs(p.geometry) > most_exact_dofs)
    throw std::invalid_argument(
        fmt::format("{}: found {} dofs; allowed: at most {} in exact arithmetic, whose numbers grow with "
                    "them. Use fewer elements",
                    file, dofs(p.geometry), most_exact_dofs));
  const demand takes = demand_of(p);
  if (takes.bytes() > memory_limit())
    throw std::invalid_argument(
        fmt::format("{}: exact arithmetic: found {}; allowed: {} (CONTCT_MEMORY_MIB in the environment sets "
                    "another limit). Use fewer elements, or numbers of fewer digits",
                    file, takes.words(), bytes_words(memory_limit())));
}

/// What numbers may grow to in the memory that the equations leave.
std::size_t longest_numbers(const problem& p) {
  return demand_of(p).bits_within(memory_limit(), lifted_solver::most_bits);
}

/// A matrix from elsewhere may be none of a structure, which the path's equations do not show. Those of beams
/// and plates are sums of elements, each of which is semidefinite.
void refuse_indefinite(const assembled& a, const exact_problem& p) {
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    if (p.fixed[dof] == 0 && p.stiffness[dof].at(static_cast<int>(dof)) == 0)
      throw std::invalid_argument(
          fmt::format("{}: dof {}: found no stiffness and no support; allowed: a positive entry on the "
                      "diagonal, or a support",
                      a.name, a.label_of(static_cast<int>(dof))));
  const std::optional<negative_work> shown = [&] {
    try {
      return find_negative_work(p.stiffness, p.fixed, p.place, memory_limit());
    } catch (const std::runtime_error& e) {
      throw std::invalid_argument(fmt::format("{}: {}", a.name, e.what()));
    }
  }();
  if (!shown) return;
  const auto largest = std::ranges::max_element(
      shown->motion, [](const rational& x, const rational& y) { return abs(x) < abs(y); });
  const rational size = abs(*largest);
  throw std::invalid_argument(fmt::format(
      "{}: not positive semidefinite: found work {}, in exact arithmetic, on a displacement whose largest "
      "component, 1, is at dof {}; allowed: 0 or more on every displacement that the supports allow. Rounded "
      "entries can cause this, as in the matrix of a body without supports",
      a.name, short_words(shown->work / (size * size), 6),
      a.label_of(static_cast<int>(largest - shown->motion.begin()))));
}

exact_problem exactly_read(const problem& p, const std::string& file) {
  exact_problem e = [&] {
    try {
      return exact_problem_of(p);
    } catch (const std::invalid_argument& wrong) {
      throw std::invalid_argument(fmt::format("{}: {}", file, wrong.what()));
    }
  }();
  e.longest = longest_numbers(p);
  if (const auto* const a = std::get_if<assembled>(&p.geometry.kind)) refuse_indefinite(*a, e);
  return e;
}

exact_path follow_exactly(const exact_problem& p, const exact_options& o) {
  progress shown(static_cast<std::int64_t>(p.steps.size()), "steps", o.quiet);
  const exact_progress tell = [&](int step, int increment, const rational& fraction) {
    shown.say(fmt::format("step {} of {}, increment {}, {:.0f} % of the step's load", step, p.steps.size(),
                          increment, 100.0 * rounded(fraction)));
  };
  try {
    return o.rule == "1989" ? follow_1989_path(p, tell) : follow_true_path(p, tell);
  } catch (const too_long& e) {
    throw std::invalid_argument(
        fmt::format("{}: exact numbers became too long: found {}; allowed: at most {} bits. Use numbers of "
                    "fewer digits, or fewer elements",
                    o.file, e.what(), p.longest));
  } catch (const std::runtime_error& e) {
    throw std::invalid_argument(fmt::format("{}: {}", o.file, e.what()));
  }
}

}  // namespace

exit_status run_command(const exact_options& options) {
  for (const std::string& name : options.kernels) (void)facts_of_kernel(name);
  const std::vector<output_option> outputs = {{"--json", options.json}};
  refuse_shared_outputs(outputs, {{"the problem", options.file}});
  const problem p = read_with_progress(options.file, options.quiet, literals::kept);
  refuse_too_large(p, options.file);
  const exact_problem exactly = exactly_read(p, options.file);
  const output_files files(outputs);
  const exact_path path = follow_exactly(exactly, options);

  std::vector<kernel_digits> kernels;
  if (!options.kernels.empty()) {
    const linear_structure structure = build_with_progress(p, options.quiet);
    path_progress shown(p.steps.size(), options.quiet);
    for (const std::string& name : options.kernels)
      kernels.push_back(digits_of_kernel(name, p, structure, path, shown));
  }
  const exact_result result{p, exactly, path, kernels};
  if (!options.quiet && !takes_standard_output(outputs))
    print_text(exact_text(result, options.digits, look_at_terminal()));
  flush_standard_output();
  if (output_file* const file = files["--json"]) write_exact_json(result, *file);
  if (path.status != path_status::solved)
    complain("{}: step {}, at share {} of its load: {}", options.file, path.steps.size(),
             short_words(path.steps.back().fraction, options.digits),
             path.status == path_status::mechanism ? "no equilibrium" : "the limit of increments is reached");
  return status_of(path.status);
}

}  // namespace contct::app
