// A problem as an input file for CalculiX, another program with another way of solving it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::write {

/// How a problem is to be written.
struct calculix_choice {
  int step = 0;              ///< which load step's end, from 1; 0: the last one's
  int refine = 2;            ///< elements for each of the problem's, along each side
  double slenderness = 500;  ///< the structure's length over the thickness it is given
};

/// An input file, and what is needed to read the answer back: the problem's node i (from 0) is node i + 1,
/// pair i presses on node `first_ground` + i.
struct calculix_deck {
  std::string text;
  double displacement_scale = 1.0;  ///< displacements and faces are this many times the problem's
  double force_scale = 1.0;         ///< forces likewise
  int step = 0;                     ///< from 1
  int nodes = 0;                    ///< of the mesh, without the springs' ground
  int elements = 0;                 ///< likewise
  int first_ground = 0;
};

/// Throws std::invalid_argument where the problem has what cannot be written, naming it.
[[nodiscard]] calculix_deck calculix_deck_of(const problem& p, const calculix_choice& choice);

/// A beam or a plate in CalculiX's quadratic elements: B32R lines and S8R rectangles. Deflection is along z.
/// A beam lies on the x axis, a plate in the plane of x and y. Nodes and elements count from 0; directions
/// are CalculiX's: 1 to 3 along the axes, 4 to 6 about them.
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
  std::map<std::pair<int, int>, double> forces;   ///< by node and direction
  std::map<std::pair<int, int>, double> settled;  ///< what supports are moved by, likewise
};

/// The problem's structure with `refine` by `refine` elements for each of its own, under the total load of
/// `step` (from 0). Each has a node at its middle too, so the number of intervals is even. Elastic supports
/// and pairs are not in it: they stay at the problem's own nodes.
[[nodiscard]] calculix_mesh calculix_mesh_of(const problem& p, int refine, int step);

}  // namespace contct::write
