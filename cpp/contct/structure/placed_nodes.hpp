// Where the dofs of an assembled structure are, as far as that is known: for pictures only.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::structure {

/// A node, by the name that labels of dofs have for it.
struct placed_node {
  std::string name;
  std::array<double, 3> at;
};

/// A straight line between two nodes, from 0.
struct mesh_edge {
  int from, to;
  int elements;  ///< how many have it: few at the outer edges of a solid, many inside; 1 for a coupling
};

/// Where a dof is.
struct placed_dof {
  int node = -1;      ///< from 0; -1 where that is not known
  int direction = 0;  ///< 1 to 3 along x, y and z, 4 to 6 about them; 0 where that is not known

  [[nodiscard]] bool is_length() const { return direction >= 1 && direction <= 3; }
};

struct placed_nodes {
  std::vector<placed_node> nodes;  ///< empty: nothing is known
  std::vector<mesh_edge> edges;    ///< from < to, each once
  std::vector<placed_dof> dofs;    ///< [dofs]; empty with `nodes`
  std::vector<std::string> said;   ///< what of the files is not drawn, a sentence each

  [[nodiscard]] bool known() const { return !nodes.empty(); }
};

}  // namespace contct::structure
