// What an engineer reads off a state: extremes, reactions and contact forces; and off a whole path: its
// envelope.
#pragma once

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

/// The deflection of node `node`, from 0, under the displacement `u` [dofs].
[[nodiscard]] double deflection_of(const problem& p, std::span<const double> u, int node);

/// The nodes whose displacement is a deflection: all of a beam and a plate. Of a matrix the dofs that are
/// known to be lengths: those that meet faces, and those along an axis where places are known; all where
/// there are neither.
[[nodiscard]] std::vector<int> deflecting_nodes(const problem& p);

/// A node's name in tables: its number, from 1, or its label where each dof is a node of its own.
[[nodiscard]] std::string place_name(const model& m, int node);

/// Where a node is: x along a beam; x and y on a plate.
struct place {
  double x = 0.0, y = 0.0;
};
[[nodiscard]] place place_of_node(const model& m, int node);

/// The nodes of a beam's or a plate's element, in the order in which element_results have its values.
[[nodiscard]] std::vector<int> nodes_of_element(const model& m, int element);

/// What a picture tells apart: at its face are pairs whose gap the listing takes for zero (under EPSGAP),
/// whatever their status: stationary ones, which carry no force worth the name.
enum class pair_state { open, closed, at_face };

/// How a pair stands, and its gap and force as results have them.
struct pair_reading {
  double w, gap, force;
  pair_state look;
  double face;  ///< where it is now
};
/// At deflection `w`; of a pair whose face is where it is now.
[[nodiscard]] pair_reading reading_of(const contact_pair& p, double w, bool closed);

/// Read off one state. Pairs, supports and nodes count from 0.
struct step_results {
  std::vector<value_range> ranges;  ///< see ranges_of
  element_results elements;
  element_results stresses;         ///< see stresses_of
  std::vector<double> reactions;    ///< [supports]
  std::vector<pair_reading> pairs;  ///< [pairs]
  /// Of a beam's elements in which loads begin, end or stand, or impose a curvature: see beam_lines.
  std::map<std::size_t, std::vector<element_line>> pieces = {};

  /// The pair that presses hardest; none where no pair presses.
  [[nodiscard]] std::optional<std::size_t> hardest_pair() const;
  /// The support with the largest force: moments on supports do not count.
  [[nodiscard]] std::optional<std::size_t> hardest_support(const problem& p) const;
};

/// Of a state under load `l`; numbers_of leaves out ranges, stresses and pieces.
[[nodiscard]] step_results numbers_of(const problem& p, const load& l, const structure_state& s);
[[nodiscard]] step_results results_of(const problem& p, const load& l, const structure_state& s);

/// The sums of the upward forces on a structure: in equilibrium they add up to 0, but for rounding.
struct force_balance {
  double loads, reactions, contact;
};
/// None of a matrix, which does not say what is up.
[[nodiscard]] std::optional<force_balance> balance_of(const problem& p, const load& l, const step_results& r);

/// What a bed does to the structure.
struct bed_reading {
  value_range pressure;  ///< force over tributary share, at the bed's nodes
  double contact = 0.0;  ///< the shares of its pairs that are in contact: a length or an area
};
/// Of each bed in state `s`, from which `r` was read.
[[nodiscard]] std::vector<bed_reading> beds_in(const problem& p, const step_results& r,
                                               const structure_state& s);

/// What beds press on the structure by, at each node: force over tributary share [nodes].
[[nodiscard]] std::vector<double> bed_pressure(const problem& p, const std::vector<pair_reading>& pairs);

/// A beam that passes through a face between two neighbouring pairs that have it: contact there is not in the
/// model.
struct penetration {
  double depth = 0.0;                 ///< beyond the face, and beyond where the pairs themselves are
  double x = 0.0;                     ///< where it is deepest
  std::size_t first = 0, second = 0;  ///< the pairs, from 0
};
/// The deepest one in a state, where that is more than a thousandth of the largest deflection.
[[nodiscard]] std::optional<penetration> deepest_penetration(const problem& p, const load& l,
                                                             std::span<const double> u);

/// Where ranges_of looks: "the whole length", "nodes and corners of elements" or "dofs".
[[nodiscard]] std::string_view ranges_are_at(const model& m);

/// A place in words: "node 9, x = 4", "x = 4.31", "node 9, (1, 0.5)" or "dof 185.3".
[[nodiscard]] std::string place_words(const model& m, const placed_value& at);

/// The least and largest of everything on a path: after its increments, as far as their states can be solved
/// for, and at the ends of its steps; of combinations, which start from zero, at their ends under full load
/// alone.
struct envelope {
  /// A value, and the increment of a step, from 1, that had it; increment 0: the step ended without one.
  template <class Value>
  struct reached {
    Value value;
    int step = 0, increment = 0;
  };
  template <class Value>
  struct range {
    reached<Value> least, most;
  };

  int states = 0;
  std::vector<std::string_view> names;      ///< of the quantities
  std::vector<range<placed_value>> values;  ///< of each of them
  std::vector<reached<double>> pairs;       ///< the largest force of each, or 0 [pairs]
  std::vector<range<double>> reactions;     ///< [supports]
};

/// Of a run whose recorder keeps states, or of combinations.
[[nodiscard]] envelope envelope_of(const run_result& r);

/// The envelope along a beam: how small and how large each quantity gets at each place, and in which state.
/// Empty for plates and matrices, and where no state is known.
struct envelope_curves {
  struct curve {
    std::string_view name;                    ///< "w", "moment" or "shear"
    std::vector<envelope::range<double>> at;  ///< [places]
  };
  /// Nodes, and places at equal distances in each element where there are fewer than 480 elements. A node
  /// between two elements is there twice, as the end of one and the start of the other: the shear may jump.
  std::vector<double> x;
  std::vector<curve> curves;
};

/// Over the same states as envelope_of.
[[nodiscard]] envelope_curves curves_of(const run_result& r);

}  // namespace contct
