// What a page leaves out of a large problem, so that it stays quick: chosen evenly, and said.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "contct/write/finished_run.hpp"

namespace contct {

/// Which nodes, grid lines and pairs a page shows; all counted from 0, rising.
struct shown_parts {
  std::vector<int> nodes;    ///< of a beam, or of a structure from elsewhere whose places are known
  std::vector<int> edges;    ///< of the latter
  double reach = 0.0;        ///< of the latter: the largest displacement of these nodes on the path
  std::vector<int> columns;  ///< grid lines of a plate
  std::vector<int> rows;
  std::vector<std::size_t> pairs;
  std::vector<int> supports;    ///< the nodes whose supports are drawn
  std::vector<int> deflecting;  ///< all nodes that deflect: see deflecting_nodes
  std::size_t watched = 0;      ///< the one that does so most on the path; always shown

  std::vector<std::string> said;  ///< what was left out and how it was chosen; empty: nothing was
};

/// At most so many places of a shape, and states of pairs, in all frames together.
inline constexpr std::size_t most_places = 24'000;
inline constexpr std::size_t most_grid_points = 90'000;
inline constexpr std::size_t most_pair_states = 36'000;
inline constexpr std::size_t most_mesh_numbers = 900'000;
/// And of these in any one frame.
inline constexpr std::size_t most_pairs = 1000;
inline constexpr std::size_t most_pairs_of_a_beam = 300;
inline constexpr std::size_t most_supports = 300;
inline constexpr std::size_t most_edges = 20'000;
inline constexpr std::size_t most_loads = 60;

[[nodiscard]] shown_parts choose_parts(const finished_run& r);

/// `count` of the numbers from 0 to `all` - 1, evenly, the first and last among them; all where they are
/// no more than that.
[[nodiscard]] std::vector<int> evenly(int all, int count);

}  // namespace contct
