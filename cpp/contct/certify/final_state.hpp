// Where the reference solution is the end of a step: as a fallback, and in place of a path.
#pragma once

#include <span>

#include "contct/path/path.hpp"

namespace contct::certify {

/// A fallback for `s`, which must outlive it: the reference solution as the end of a step that a path cannot
/// reach.
[[nodiscard]] fallback_solver fallback_to_reference(const linear_structure& s);

/// Only the ends: find the equilibrium under the total load of every step and tell it to the observers as
/// that step's end.
/// An elastic structure on one-sided springs without friction has no memory: each is where the path would
/// arrive. A handful of factorisations a step; no increments, no events.
///
/// Ends as `mechanism` at the first step whose load nothing carries, and as `not_factored` where no
/// answer is found in double precision; that step is not told.
path_end find_final_states(const linear_structure& s, int steps, const load_history& total_load,
                           std::span<observer* const> observers);

}  // namespace contct::certify
