// Which parts of a large run its page and picture show, so that they stay quick to read and to draw.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "contct/write/finished_run.hpp"

namespace contct::write {

/// At most so many numbers in all frames together: places along a beam, points of a plate's grid, states of
/// pairs, displacements of a mesh.
inline constexpr std::size_t most_places = 24'000;
inline constexpr std::size_t most_grid_points = 90'000;
inline constexpr std::size_t most_pair_states = 36'000;
inline constexpr std::size_t most_mesh_numbers = 900'000;
/// At most so many in any one frame.
inline constexpr std::size_t most_pairs = 1000;
inline constexpr std::size_t most_pairs_of_a_beam = 300;
inline constexpr std::size_t most_supports = 300;
inline constexpr std::size_t most_edges = 20'000;
inline constexpr std::size_t most_loads = 60;
inline constexpr std::size_t most_events = 60;  ///< of an increment
/// Places along a beam at which its distributed load is given.
inline constexpr int load_samples = 25;

/// Which nodes, grid lines and pairs are shown; all counted from 0, rising.
struct shown_parts {
  std::vector<int> nodes;    ///< of a beam, or of a structure from elsewhere whose places are known
  std::vector<int> edges;    ///< of the latter
  double reach = 0.0;        ///< of the latter: the largest displacement of these nodes on the path
  std::vector<int> columns;  ///< grid lines of a plate
  std::vector<int> rows;
  std::vector<int> pairs;
  std::vector<int> supports;    ///< the nodes whose supports are drawn
  std::vector<int> deflecting;  ///< all nodes that deflect: see deflecting_nodes
  int watched = 0;              ///< the one of these that deflects most on the path; always shown

  std::vector<std::string> omissions;  ///< what is left out and how the rest was chosen; empty: nothing is
};

[[nodiscard]] shown_parts choose_parts(const finished_run& r);

/// `count` of the numbers from 0 to `all` - 1, evenly, the first and last among them; all where they are
/// no more than that.
[[nodiscard]] std::vector<int> evenly(std::size_t all, std::size_t count);

/// The largest of these loads, at most `most_loads`, by falling magnitude.
[[nodiscard]] std::vector<point_load> largest_loads(std::vector<point_load> loads);

/// The force per length of `l` at `load_samples` even places from end to end.
[[nodiscard]] std::vector<double> sampled_load(const beam& b, const load& l);

}  // namespace contct::write
