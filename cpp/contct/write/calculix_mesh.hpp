// A beam or a plate in quadratic elements, as CalculiX has them: B32R lines and S8R rectangles.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::write {

/// Deflection is along z. A beam lies on the x axis, a plate in the plane of x and y. Nodes and elements
/// count from 0; directions are CalculiX's: 1 to 3 along the axes, 4 to 6 about them.
struct calculix_mesh {
  struct place {
    double x, y;
  };
  struct fixed_dof {
    int node, direction;
  };
  std::vector<place> nodes;                ///< the problem's own first, in their order
  std::vector<std::vector<int>> elements;  ///< 3 nodes along a line, or 4 corners and 4 middles
  std::vector<int> origins;                ///< [elements] the problem's element that each is part of
  std::vector<fixed_dof> fixed;            ///< by the supports, and what holds the structure in its plane
  std::map<std::pair<int, int>, double> forces;  ///< by node and direction
};

/// The problem's structure with `refine` by `refine` elements for each of its own, under the total load of
/// `step` (from 0). Each has a node at its middle too, so the number of intervals is even. Elastic supports
/// and pairs are not in it: they stay at the problem's own nodes.
[[nodiscard]] calculix_mesh calculix_mesh_of(const problem& p, int refine, int step);

}  // namespace contct::write
