// A state of the whole structure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "contct/kernel/call.hpp"
#include "contct/structure/statics.hpp"

namespace contct {

/// Where a state comes from.
enum class origin { path, exact_path, reference };

/// Results of a state, more accurate than results computed from the rounded displacements. An empty list is
/// computed.
using end_numbers = statics<double>;

struct structure_state {
  int step = 0;                           ///< from 1; 0: before the first step
  int number = 0;                         ///< increment in the step, from 1; 0: the step ended without one
  double fraction = 0.0;                  ///< share of the step's load applied
  std::vector<double> displacement = {};  ///< D at every dof [dofs]
  std::vector<int> isep = {};             ///< status of each pair [pairs]
  end_numbers numbers = {};
  origin from = origin::path;

  [[nodiscard]] bool closed(std::size_t pair) const { return isep[pair] == in_contact; }
  [[nodiscard]] std::ptrdiff_t pairs_in_contact() const { return std::ranges::count(isep, in_contact); }
};

/// The status of each pair before any load [pairs].
template <class Pair>
[[nodiscard]] std::vector<int> statuses_at_start(const std::vector<Pair>& pairs) {
  std::vector<int> isep;
  isep.reserve(pairs.size());
  for (const Pair& p : pairs) isep.push_back(p.closed ? in_contact : separated);
  return isep;
}

}  // namespace contct
