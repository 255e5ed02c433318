// What supports do to the structure.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "contct/structure/load.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// What the elements beside a dof need to be held where they are, beyond their own loads.
using need_of_elements = std::function<double(int node, int dof)>;

/// The force (or moment) on the structure by each support, in the order of `supports`: minus
/// spring times displacement for an elastic one; for a fixed one, what the elements beside it
/// need beyond the point loads at its dof. A dof fixed twice gives its reaction to the first.
[[nodiscard]] std::vector<double> reactions_of(std::span<const support> supports, const load& l,
                                               std::span<const double> u, int dofs_per_node,
                                               const need_of_elements& need);

}  // namespace contct
