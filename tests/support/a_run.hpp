// A whole run in memory, for the tests of what is written about it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/write/run_result.hpp"
#include "read/good_problem.hpp"

namespace contct::app {

/// The good problem with a second step, which loads the beam upwards, towards a stop above it.
inline const std::string loaded_and_freed =
    std::string(good_problem) +
    "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 0.001\nstiffness = 1e5\n"
    "[[step]]\npoint = [ { node = 3, w = 60.0 } ]\n";

/// Clamped on the left, on a support on the right: two elements, EI = 100, length 2, q = -8.
inline const std::string propped_cantilever =
    "[beam]\nlength = 2.0\nelements = 2\nEI = 100.0\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[support]]\nnode = 3\nfix = [\"w\"]\n[[step]]\nuniform = -8.0\n";

/// FORTRAN leading C++ in lockstep, or another kernel alone, seen by all that pictures are made from.
struct a_run {
  problem what;
  linear_structure structure;
  std::unique_ptr<kernel> leader;
  lockstep_on_path compared;
  frame_keeper kept;
  run_recorder record;
  certifier judged;
  early_toggles early;
  path_end end;

  explicit a_run(const std::string& text, const std::vector<observer*>& more = {},
                 const frame_limits& limits = {}, const std::string& leads = "fortran")
      : what(parse_problem(text, "pb.toml", reach::anywhere)),
        structure(structure_of(what)),
        leader(make_kernel(leads)),
        compared(leader->facts(), std::vector<std::string>(leads == "fortran" ? 1 : 0, "cpp")),
        kept(structure, loads_of(what, structure), false, limits),
        record(&compared, true),
        judged(what, structure) {
    std::vector<observer*> watching = {&compared, &judged, &early, &kept, &record};
    watching.insert(watching.end(), more.begin(), more.end());
    end = follow(what, structure, "refactor", *leader, watching);
    leader.reset();  // unit 26 is there only once
  }

  [[nodiscard]] run_result result() const {
    return {.what = what,
            .record = record,
            .judged = judged,
            .early = early,
            .end = end,
            .file = "pb.toml",
            .kernels = {"fortran", "cpp"},
            .engine = "refactor",
            .compared = &compared,
            .comparison = "all equal",
            .facts = {"contct 0"},
            .frames = kept.frames()};
  }
};

}  // namespace contct::app
