// A path explained in memory, for the tests of what is written about it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contct/kernel/registry.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct {

/// FORTRAN with C++ beside it; `sink` is given each increment, after `first`, where there is one, has seen
/// it. Returns the path, which has the totals.
inline explained_path explain_run(const problem& p, explained_path::sink sink, observer* first = nullptr) {
  const auto leader = make_kernel("fortran");
  explained_path path(leader->facts(), make_kernel("cpp"), {}, std::move(sink));
  std::vector<observer*> watching = {&path};
  if (first != nullptr) watching.insert(watching.begin(), first);
  follow(p, structure_of(p), "refactor", *leader, watching);
  return path;
}

/// A stop that is touched at a quarter of the load, and a clamped node over a face that it never leaves.
inline const char* const two_pairs =
    "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.25\nstiffness = 1\n"
    "[[contact]]\nnode = 1\nsurface = \"below\"\nface = -1\nstiffness = 1\n"
    "[[step]]\npoint = [ { node = 2, w = -3 } ]\n";

}  // namespace contct
