// contct exact: the path in rational arithmetic, and how many digits of each kernel are right.
#include <stdexcept>

#include "app/problem_runs.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/exact/exact_problem.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
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
                              {0, fallback_to_reference(s)});
  shown.line.erase();
  return counter.result(name, end.status, rounding[leader->facts().real_bytes == 4 ? 1 : 0]);
}

/// A problem that would take more than a machine has is refused before it is converted.
void refuse_too_large(const problem& p, const std::string& file) {
  if (dofs(p.geometry) > most_exact_dofs)
    throw std::invalid_argument(fmt::format(
        "{}: found {} dofs; allowed: at most {} in exact arithmetic, whose numbers grow with them. "
        "Fewer elements would do",
        file, dofs(p.geometry), most_exact_dofs));
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
        fmt::format("{}: exact numbers became too long: found {}; allowed: at most {} bits. Numbers of fewer "
                    "digits, or fewer elements, would help",
                    o.file, e.what(), lifted_solver::most_bits));
  } catch (const std::runtime_error& e) {
    throw std::invalid_argument(fmt::format("{}: {}", o.file, e.what()));
  }
}

}  // namespace

exit_status run_command(const exact_options& options) {
  for (const std::string& name : options.kernels) (void)facts_of_kernel(name);
  const std::vector<output_option> outputs = {{"--json", options.json}};
  refuse_shared_outputs(outputs, {{"the problem", options.file}});
  const problem p = read_with_progress(options.file, options.quiet);
  refuse_too_large(p, options.file);
  // The equations that are solved here do not show whether a matrix is indefinite: its structure is refused.
  if (std::holds_alternative<assembled>(p.geometry.kind)) (void)build_with_progress(p, options.quiet);
  const output_files files(outputs);
  const exact_problem exactly = exact_problem_of(p);
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
