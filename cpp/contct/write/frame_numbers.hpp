// What one reads off a frame: over all nodes, elements and pairs.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "contct/path/frames.hpp"
#include "contct/structure/problem.hpp"
#include "contct/write/load_text.hpp"

namespace contct {

/// The load of a frame; nothing before the first step.
[[nodiscard]] load load_of(const load_path& loads, const frame& f);

/// The deflection of node `node`, from 0.
[[nodiscard]] double deflection_of(const problem& p, const frame& f, std::size_t node);

/// How a pair stands in a frame, and its gap and force as results have them.
struct pair_reading {
  double w, gap, force;
  pair_look look;
};
[[nodiscard]] pair_reading reading_of(const problem& p, const frame& f, std::size_t pair);

/// A place and the value there.
struct extreme {
  std::size_t at = 0;
  double value = 0.0;
};

/// The nodes whose displacement is a deflection: all of a beam and a plate. Of a matrix the dofs that are
/// known to be lengths: those that meet faces, and those along an axis where places are known; all where
/// there are neither.
[[nodiscard]] std::vector<int> deflecting_nodes(const problem& p);

/// The one of these nodes that deflects most.
[[nodiscard]] extreme largest_deflection(const problem& p, const frame& f, std::span<const int> among);

/// Pairs of each look: open, closed, at their faces.
struct pair_counts {
  std::size_t open = 0, closed = 0, at_face = 0;
  [[nodiscard]] std::size_t& of(pair_look look) {
    return look == pair_look::open ? open : look == pair_look::closed ? closed : at_face;
  }
};
[[nodiscard]] pair_counts count_pairs(const problem& p, const frame& f);

/// A word for a look: "open", "closed", "at its face".
[[nodiscard]] const char* words_of(pair_look look);

/// A node's name in tables: its number, from 1, or its label where each dof is a node of its own.
[[nodiscard]] std::string place_name(const model& m, int node);

/// Where a node is: x along a beam; x and y on a plate.
struct place {
  double x = 0.0, y = 0.0;
};
[[nodiscard]] place place_of_node(const model& m, int node);

}  // namespace contct
