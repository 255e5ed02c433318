#include "app/problem_runs.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/kernel_report.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/words.hpp"

namespace contct {

namespace fs = std::filesystem;

std::vector<std::string> engine_choices() {
  std::vector<std::string> names = engine_names();
  names.insert(names.begin(), "auto");
  if (std::ranges::find(names, "petsc") == names.end()) names.emplace_back("petsc");
  return names;
}

void refuse_engine_option(const std::string& name) {
  const std::vector<std::string> names = engine_choices();
  if (std::ranges::find(names, name) != names.end()) return;
  throw std::invalid_argument(fmt::format("--engine: no engine is named \"{}\"{}; allowed: {}", name,
                                          did_you_mean(name, names), joined(names, ", ")));
}

problem read_with_warnings(const problem_options& options, const std::vector<output_option>& outputs) {
  std::vector<output_option> inputs = {{"the problem", options.file}};
  refuse_shared_outputs(outputs, inputs);
  problem p = read_problem(options.file, options.allow_outside ? reach::anywhere : reach::own_folder);
  for (const std::string& named : p.files) inputs.push_back({named_by_problem, named});
  refuse_shared_outputs(outputs, inputs);
  for (const std::string& w : p.warnings) complain("warning: {}", whole_line(w));
  return p;
}

fs::path find_reference(const std::string& asked) {
  if (!asked.empty()) return asked;
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  std::string looked_at;
  for (const char* from_here : {CONTCT_INSTALLED_REFERENCE, "../../reference"}) {
    fs::path found = (here / from_here).lexically_normal();
    if (fs::exists(found / "verification.toml")) return found;
    looked_at += (looked_at.empty() ? "" : " nor ") + (found / "verification.toml").string();
  }
  throw input_error("there is neither " + looked_at + "; name the folder with --reference");
}

std::vector<std::string> golden_faults(kernel& k) {
  fs::path folder;
  try {
    folder = find_reference("") / "traces";
  } catch (const input_error&) {
    return {};
  }
  std::vector<fs::path> files;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".trace") files.push_back(entry.path());
  std::ranges::sort(files);
  fault_finder answers;
  for (const fs::path& file : files) {
    const std::string text = read_input(file.string(), "trace");
    trace_reader calls(text, file.string());
    const trace_header h = calls.read_header();
    if (comparable(h, k.facts())) answers = replay(h, calls, k, nullptr, std::move(answers)).faults;
  }
  return known_faults(answers);
}

path_progress::path_progress(std::size_t steps, bool quiet)
    : line(static_cast<std::int64_t>(steps), "steps", quiet), steps_(steps) {}

void path_progress::called(const answered_call& /*c*/) {
  line.say(fmt::format("step {} of {}, increment {}", step_, steps_, ++number_));
}

void path_progress::incremented(const increment& i) {
  line.say(fmt::format("step {} of {}, increment {}, {:.0f} % of the step's load", i.step, steps_,
                       i.number + 1, 100.0 * i.fraction));
}

void path_progress::step_ended(const step_state& s) {
  step_ = s.step + 1;
  number_ = 0;
}

}  // namespace contct
