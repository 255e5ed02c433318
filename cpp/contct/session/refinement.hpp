// What a finer mesh would change: the same problem with every element halved, and the two results compared.
#pragma once

#include "contct/session/run_result.hpp"

namespace contct {

/// Every element of a beam in two, of a plate in four; loads, supports and [[contact]] stay where they are. A
/// new node is on a bed where all of its neighbours are, or may be because they are fixed in w. On a plate a
/// dof that is fixed at all of its neighbours is fixed there too, and settles by their mean.
[[nodiscard]] problem refined(const problem& p);

/// How much the extremes ("w", "moment", "shear", "mx", ..), the contact forces of [[contact]] ("force"), the
/// "pressure" of beds and a beam's reactions ("reaction") differ at most in any step.
[[nodiscard]] std::vector<mesh_change> changes_between(const run_result& coarse, const run_result& fine);

}  // namespace contct
