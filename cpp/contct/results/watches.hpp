// The extremes of the parts that a problem's [[watch]] tables name.
#pragma once

#include <cstddef>
#include <vector>

#include "contct/results/quantities.hpp"
#include "contct/results/step_results.hpp"

namespace contct {

/// The least and largest value of a quantity in a part, from 0. `where` is the node's place; of a bed, the
/// place with that pressure.
struct watched_range {
  std::size_t part = 0;
  const quantity_row* row = nullptr;
  placed_value least, most;
};

/// A value at a node; `name`: of the entry that has it.
[[nodiscard]] placed_value at_node(const problem& p, double value, int node, std::string_view name = {});

/// All quantities of all parts, part after part. A range of places has the extremes of the structure and the
/// pressure of beds there; names have reactions, contact forces, gaps, and pressures of beds.
[[nodiscard]] std::vector<watched_range> watched_in(const step_results& r);

}  // namespace contct
