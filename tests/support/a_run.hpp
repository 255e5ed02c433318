// A run in memory, for tests of outputs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/session/path_states.hpp"
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

/// A run with everything that outputs need: of FORTRAN with C++ in lockstep, or of one other kernel alone.
struct a_run {
  const problem what;
  const linear_structure structure;
  run_result result;

  explicit a_run(const std::string& text, const std::string& leads = "fortran")
      : a_run(parse_problem(text, "pb.toml", reach::anywhere), leads) {}

  explicit a_run(problem p, const std::string& leads = "fortran")
      : what(std::move(p)), structure(structure_of(what)), result(what, structure) {
    const std::unique_ptr<kernel> leader = make_kernel(leads);
    std::vector<observer*> watching = {&result.judged, &result.early, &result.record};
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
    result.end = follow(what, structure, "refactor", *leader, watching, {0, result.judged.ends()});
  }
};

}  // namespace contct
