// A run in memory, for tests of outputs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/envelope.hpp"
#include "contct/results/path_states.hpp"
#include "contct/results/step_results.hpp"
#include "read/good_problem.hpp"

namespace contct {

/// `good_problem` with a second step, which presses the beam up against a stop above it.
inline const std::string loaded_and_freed =
    std::string(good_problem) +
    "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 0.001\nstiffness = 1e5\n"
    "[[step]]\npoint = [ { node = 3, w = 60.0 } ]\n";

/// A propped cantilever: two elements, EI = 100, length 2, q = -8.
inline const std::string propped_cantilever =
    "[beam]\nlength = 2.0\nelements = 2\nEI = 100.0\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[support]]\nnode = 3\nfix = [\"w\"]\n[[step]]\nuniform = -8.0\n";

/// Two spans of 6, of which the first is loaded: the reactions are 52.5, 75 and -7.5.
inline const std::string loaded_span =
    "[beam]\nlength = 12\nelements = 12\nEI = 3e4\n[[support]]\nx = [0, 6, 12]\nfix = \"w\"\n"
    "[[step]]\nuniform = [ { value = -20, from = 0, to = 6 } ]\n";

/// Returns a beam with this number of elements on springs, pressed at its middle.
inline std::string lying_beam(int elements) {
  return "[beam]\nlength = 10.0\nelements = " + std::to_string(elements) +
         "\nEI = 1.0\n[[contact]]\nnodes = 'all'\nsurface = 'below'\nface = 0\nstiffness = 1e3\n"
         "[[step]]\npoint = [ { node = " +
         std::to_string(elements / 2 + 1) + ", w = -1.0 } ]\n";
}

inline problem parsed(const std::string& text) {
  return parse_problem(text, "pb.toml", reach::anywhere);
}

/// A run with everything that outputs need: of FORTRAN with C++ in lockstep, or of one other kernel alone.
struct a_run {
  const problem what;
  const linear_structure structure;
  run_result result;

  explicit a_run(const std::string& text, const std::string& leads = "fortran")
      : a_run(parsed(text), leads) {}

  explicit a_run(problem p, const std::string& leads = "fortran")
      : what(std::move(p)), structure(structure_of(what)), result(what, structure) {
    const std::unique_ptr<kernel> leader = make_kernel(leads);
    certifier proof(what, structure);
    std::vector<observer*> watching = {&result.early, &result.record};
    if (leads == "fortran") {
      result.compared.emplace(leader->facts(), std::vector<std::string>{"cpp"});
      watching.insert(watching.begin(), &*result.compared);
    }
    result.record =
        run_recorder(result.compared ? &*result.compared : nullptr, {.calls = true, .states = true});
    result.file = "pb.toml";
    result.kernels = {"fortran", "cpp"};
    result.engine = "refactor";
    result.comparison = "all equal";
    result.facts = {"contct 0"};
    result.take(follow(what, structure, "refactor", *leader, watching, &proof));
  }

  /// Returns the state at the end of a recorded step, from 0, and its results.
  [[nodiscard]] const structure_state& end(std::size_t step = 0) const {
    return result.record.steps.at(step);
  }
  [[nodiscard]] step_results results(std::size_t step = 0) const { return {what, end(step)}; }
};

/// The ranges of a quantity in an envelope, by its key.
inline const std::vector<envelope::range>& listed(const envelope& all, std::string_view key) {
  return std::ranges::find(all.lists, key, [](const auto& l) { return l.row->key; })->at;
}

/// Returns the run of a file of reference/problems under the corrected rule.
inline a_run reference_run(const std::string& name) {
  return a_run(read_problem(CONTCT_REFERENCE "/problems/" + name + ".toml"), "corrected");
}

}  // namespace contct
