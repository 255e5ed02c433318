// The least and largest values on a path.
#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "contct/results/quantities.hpp"
#include "contct/results/run_result.hpp"

namespace contct {

/// The least and largest values on a path: after its increments, if path_states finds their displacements,
/// and at the ends of its steps. Of combinations only the ends under full load count.
struct envelope {
  /// A value with its place, step and increment, from 1, which are the first of those with an equal value
  /// (see tie_of). Increment 0: the step ended without an increment.
  struct reached : placed_value {
    int step = 0, increment = 0;
    double first = 0.0;  ///< the value in this step and increment
  };
  struct range {
    reached least, most;
  };
  /// The extremes of a quantity at one or more places.
  struct listed {
    const quantity_row* row;
    std::vector<range> at = {};
    std::size_t part = 0;  ///< of the problem's watches
  };

  int states = 0;               ///< the number of states
  std::vector<listed> values;   ///< of the whole structure
  std::vector<listed> watched;  ///< of the watched parts
  std::vector<listed> lists;    ///< of each support, bed and hinge, and the force and gap of each pair

  /// The places of the curves along a beam: nodes and, if there are fewer than 480 elements, equidistant
  /// places in each element. A node between two elements is listed twice, because the shear may jump there.
  /// Empty for plates and matrices, and if no state is known.
  std::vector<double> x;
  std::vector<listed> curves;  ///< of each quantity of along_beam, and of those of beds at nodes, at each x
};

/// The envelope of a run whose recorder keeps states, or of combinations.
[[nodiscard]] envelope envelope_of(const run_result& r, bool with_curves = false);

/// At most `most` combinations of a run, ascending, from 1: those that did not reach their load and those
/// with an extreme of the envelope first, then others at equal distances.
[[nodiscard]] std::set<int> governing_steps(const run_result& r, std::size_t most);

}  // namespace contct
