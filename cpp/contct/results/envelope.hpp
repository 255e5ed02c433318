// The least and largest values on a path.
#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "contct/results/quantities.hpp"
#include "contct/results/run_result.hpp"
#include "contct/results/watches.hpp"

namespace contct {

/// The least and largest values on a path: after its increments, if path_states finds their displacements,
/// and at the ends of its steps. Of combinations only the ends under full load count.
struct envelope {
  /// A value with its place, step and increment, from 1, which are the first of those with an equal value
  /// (see tie_of). Increment 0: the step ended without an increment.
  template <class Value>
  struct reached {
    Value value;
    int step = 0, increment = 0;
    double first = 0.0;  ///< the value in this step and increment
  };
  template <class Value>
  struct range {
    reached<Value> least, most;
  };

  /// A number of each support, bed or hinge, or the force or gap of each pair.
  struct listed {
    const quantity_row* row;
    std::vector<range<double>> at;
  };

  int states = 0;  ///< the number of states
  std::vector<std::string_view> names;
  std::vector<range<placed_value>> values;  ///< least and largest value for each name
  std::vector<listed> lists;
  std::vector<watched_range> watched;               ///< the parts and their quantities
  std::vector<range<placed_value>> values_watched;  ///< [watched]
};

/// The envelope of a run whose recorder keeps states, or of combinations.
[[nodiscard]] envelope envelope_of(const run_result& r);

/// At most `most` combinations of a run, ascending, from 1: those that did not reach their load and those
/// with an extreme of the envelope first, then others at equal distances.
[[nodiscard]] std::set<int> governing_steps(const run_result& r, std::size_t most);

/// The envelope along a beam: the least and largest value of each quantity at each place, each with its step
/// and increment. Empty for plates and matrices, and if no state is known.
struct envelope_curves {
  struct curve {
    std::string_view name;                    ///< a key of along_beam, or of a quantity of beds at nodes
    std::vector<envelope::range<double>> at;  ///< [places]
  };
  /// The places: nodes and, if there are fewer than 480 elements, equidistant places in each element. A node
  /// between two elements is listed twice, because the shear may jump there.
  std::vector<double> x;
  std::vector<curve> curves;
};

[[nodiscard]] envelope_curves curves_of(const run_result& r);

}  // namespace contct
