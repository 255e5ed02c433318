// contct exact: the path in rational arithmetic, and how many digits of each kernel are right.
#include "app/problem_runs.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/write/exact_output.hpp"

namespace contct {

exit_status run_command(const exact_options& options) {
  for (const std::string& name : options.kernels) (void)facts_of_kernel(name);
  const std::vector<output_option> outputs = {{"--json", options.json}};
  const problem p = read_with_progress(options.file, outputs, options.allow_outside, options.quiet);
  const output_files files(outputs);
  progress path_shown(static_cast<std::int64_t>(p.steps.size()), "steps", options.quiet);
  const exact_progress tell = [&](int step, int increment, const rational& fraction) {
    path_shown.say(fmt::format("step {} of {}, increment {}, {:.0f} % of the step's load", step,
                               p.steps.size(), increment, 100.0 * rounded(fraction)));
  };
  path_progress kernels_shown(p.steps.size(), options.quiet);
  const exact_run run = run_exactly(p, {options.file, options.rule, options.kernels}, tell, &kernels_shown);
  path_shown.erase();
  kernels_shown.line.erase();
  const exact_path& path = run.path;
  if (!options.quiet && !takes_standard_output(outputs))
    print_text(exact_text(run, options.digits, look_at_terminal()));
  flush_standard_output();
  if (output_file* const file = files["--json"]) write_exact_json(run, *file);
  if (path.status != path_status::solved)
    complain("{}: step {}, at share {} of its load: {}", whole_line(options.file), path.steps.size(),
             short_words(path.steps.back().fraction, options.digits),
             path.status == path_status::mechanism ? "no equilibrium"
             : path.status == path_status::path_ended
                 ? "the path of the 1989 rule ended: nothing held the structure"
                 : "the limit of increments is reached");
  return status_of(path.status);
}

}  // namespace contct
