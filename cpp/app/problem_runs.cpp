#include "app/problem_runs.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/kernel_report.hpp"
#include "contct/linear/cholesky.hpp"
#include "contct/read/problem_file.hpp"

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

std::vector<std::string> beside_program(std::string_view name, std::initializer_list<const char*> folders) {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  std::vector<std::string> places;
  for (const char* folder : folders) places.push_back((here / folder / name).lexically_normal());
  return places;
}

fs::path find_reference(const std::string& asked) {
  if (!asked.empty()) return asked;
  const std::vector<std::string> places =
      beside_program("verification.toml", {CONTCT_INSTALLED_REFERENCE, "../../reference"});
  for (const std::string& place : places)
    if (fs::exists(place)) return fs::path(place).parent_path();
  throw input_error("there is neither " + joined(places, " nor ") + "; name the folder with --reference");
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
    if (!comparable(h, k.facts())) continue;
    follower f = follower_of(h, k);
    std::swap(f.faults, answers);
    (void)replay(calls, f);
    std::swap(f.faults, answers);
  }
  return known_faults(answers);
}

void path_progress::called(const answered_call& /*c*/) {
  line.say(fmt::format("step {} of {}, increment {}", step_, steps_, ++number_));
}

void path_progress::reached(int step, int number, double fraction) {
  line.say(fmt::format("step {} of {}, increment {}, {:.0f} % of the step's load", step, steps_, number,
                       100.0 * fraction));
}

void path_progress::incremented(const increment& i) {
  reached(i.step, i.number + 1, i.fraction);
  step_ = i.fraction < 1.0 ? i.step : i.step + 1;
  number_ = i.fraction < 1.0 ? i.number : 0;
}

}  // namespace contct
