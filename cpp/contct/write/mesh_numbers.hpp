// What one reads off a structure from elsewhere whose nodes have places.
#pragma once

#include <array>
#include <vector>

#include "contct/path/frames.hpp"
#include "contct/structure/placed_nodes.hpp"

namespace contct {

using in_space = std::array<double, 3>;

/// The dof, from 0, of a node along each axis and about it; -1 where it has none.
struct dofs_of_node {
  std::array<int, 3> along{-1, -1, -1};
  std::array<int, 3> about{-1, -1, -1};

  [[nodiscard]] bool operator==(const dofs_of_node&) const = default;
};

/// Of each node.
[[nodiscard]] std::vector<dofs_of_node> dofs_of_nodes(const placed_nodes& places);

/// The axes, from 0, along which any node can go.
[[nodiscard]] std::vector<int> axes_of(const placed_nodes& places);

/// What three dofs read in a frame; 0 where there is none.
[[nodiscard]] in_space reading_at(const std::array<int, 3>& dofs, const frame& f);

/// How long it is.
[[nodiscard]] double length_of(const in_space& v);

/// A way to look at it: where right and up on the page are in space.
struct structure_view {
  const char* name;
  const char* words;
  in_space right, up;

  [[nodiscard]] double x_of(const in_space& at) const;
  [[nodiscard]] double y_of(const in_space& at) const;
};

/// Straight on to each plane of the axes, then from the front, a little from the right and from above.
inline constexpr int views = 4;
[[nodiscard]] const structure_view& view_at(int number);

/// The number of the view that shows most: straight on where one coordinate is the same for all nodes and
/// none of them can leave that plane, else the last.
[[nodiscard]] int fitting_view(const placed_nodes& places);

}  // namespace contct
