// Results of a state: extremes, reactions and contact forces; and of a whole path: its envelope.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/model/extremes.hpp"
#include "contct/session/load_path.hpp"
#include "contct/session/run_result.hpp"

namespace contct {

/// `node` counts from 0; `u`: displacements [dofs].
[[nodiscard]] double deflection_of(const problem& p, std::span<const double> u, int node);

/// The number of pairs of [[contact]]; those of beds follow them.
[[nodiscard]] std::size_t contacts_of(const problem& p);

/// The nodes whose displacement is a deflection, from 0: all of a beam or plate. In a matrix the dofs of
/// pairs and dofs along an axis, if places are known; otherwise all dofs.
[[nodiscard]] std::vector<int> deflecting_nodes(const problem& p);

/// The name of a node in tables: its number, from 1, or its label in a matrix.
[[nodiscard]] std::string place_name(const model& m, int node);

/// A position: x on a beam; x and y on a plate.
struct place {
  double x = 0.0, y = 0.0;
};
[[nodiscard]] place place_of_node(const model& m, int node);

/// The nodes of an element of a beam or plate, in the order of element_results.
[[nodiscard]] std::vector<int> nodes_of_element(const model& m, int element);

/// The state of a pair in pictures. at_face: the distance from the face is below EPSGAP, whatever the status.
enum class pair_state { open, closed, at_face };

/// The state, gap and contact force of a pair, as results contain them.
struct pair_reading {
  double w, gap, force;
  pair_state look;
  double face;  ///< the position of the face, with its move
};
/// The reading of pair `p`, with its face already moved (pairs_under), at deflection `w`.
[[nodiscard]] pair_reading reading_of(const contact_pair& p, double w, bool closed);

/// The results of one state. Pairs, supports and nodes count from 0.
struct step_results {
  std::vector<value_range> ranges;  ///< see ranges_of
  element_results elements;
  element_results stresses;         ///< see stresses_of
  std::vector<double> reactions;    ///< [supports]
  std::vector<pair_reading> pairs;  ///< [pairs]
  /// By element, from 0: its pieces, if loads begin, end, act or impose a curvature inside (see beam_lines).
  std::map<std::size_t, std::vector<element_line>> pieces = {};

  /// The pair with the largest contact force; empty if no force is positive.
  [[nodiscard]] std::optional<std::size_t> hardest_pair() const;
  /// The support with the largest force and, if others have forces of the other sign, the largest of these.
  /// Moments on supports do not count.
  [[nodiscard]] std::vector<std::size_t> hardest_supports(const problem& p) const;
};

/// The first support with the largest force (side = 1) or the least (-1); moments do not count.
[[nodiscard]] std::optional<std::size_t> extreme_support(const problem& p, int side,
                                                         const std::function<double(std::size_t)>& force_of);

/// The results of state `s` under load `l`. numbers_of computes no ranges, stresses and pieces.
[[nodiscard]] step_results numbers_of(const problem& p, const load& l, const structure_state& s);
[[nodiscard]] step_results results_of(const problem& p, const load& l, const structure_state& s);

/// The sums of the upward forces on a structure, which add up to 0 in equilibrium, except for rounding.
struct force_balance {
  double loads, reactions, contact;
};
/// The sums of a state with the results `r`; empty for a matrix, which has no upward direction.
[[nodiscard]] std::optional<force_balance> balance_of(const problem& p, const load& l, const step_results& r);

/// The contact of a bed with the structure.
struct bed_reading {
  value_range pressure;  ///< force divided by tributary length or area, at the bed's nodes
  double force = 0.0;    ///< the sum of the contact forces of its pairs
  double contact = 0.0;  ///< the tributary lengths or areas of the pairs in contact, added up
};
/// The readings of all beds in state `s`, whose results are `r`.
[[nodiscard]] std::vector<bed_reading> beds_in(const problem& p, const step_results& r,
                                               const structure_state& s);

/// The pressure of the beds at each node: force divided by tributary length or area [nodes].
[[nodiscard]] std::vector<double> bed_pressure(const problem& p, const std::vector<pair_reading>& pairs);

/// A place where a beam passes through a face between two neighbouring pairs that both have that face.
struct penetration {
  double depth = 0.0;                 ///< depth beyond the face, less the larger depth of the two pairs
  double x = 0.0;                     ///< the position with the largest depth
  std::size_t first = 0, second = 0;  ///< the pairs, from 0
};
/// The deepest penetration of a beam; empty if the depth is at most a thousandth of the largest deflection.
[[nodiscard]] std::optional<penetration> deepest_penetration(const problem& p, const load& l,
                                                             std::span<const double> u);

/// Where ranges_of searches: "the whole length", "nodes and corners of elements" or "dofs".
[[nodiscard]] std::string_view ranges_are_at(const model& m);

/// A place in words: "node 9, x = 4", "x = 4.31", "node 9, (1, 0.5)" or "dof 185.3".
[[nodiscard]] std::string place_words(const model& m, const placed_value& at);

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

  int states = 0;  ///< the number of states
  std::vector<std::string_view> names;
  std::vector<range<placed_value>> values;  ///< least and largest value for each name
  std::vector<reached<double>> pairs;       ///< the largest force of each pair, or 0 [pairs]
  std::vector<range<double>> reactions;     ///< [supports]
};

/// The envelope of a run whose recorder keeps states, or of combinations.
[[nodiscard]] envelope envelope_of(const run_result& r);

/// The envelope along a beam: the least and largest value of each quantity at each place, each with its step
/// and increment. Empty for plates and matrices, and if no state is known.
struct envelope_curves {
  struct curve {
    std::string_view name;                    ///< "w", "moment" or "shear"
    std::vector<envelope::range<double>> at;  ///< [places]
  };
  /// The places: nodes and, if there are fewer than 480 elements, equidistant places in each element. A node
  /// between two elements is listed twice, because the shear may jump there.
  std::vector<double> x;
  std::vector<curve> curves;
};

[[nodiscard]] envelope_curves curves_of(const run_result& r);

}  // namespace contct
