// The results of a state: extremes, reactions, contact forces, the results of beds.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/results/load_path.hpp"
#include "contct/results/run_result.hpp"
#include "contct/structure/extremes.hpp"

namespace contct {

/// `node` counts from 0; `u`: displacements [dofs].
[[nodiscard]] double deflection_of(const problem& p, std::span<const double> u, int node);

/// The number of pairs of [[contact]]; those of beds follow them.
[[nodiscard]] std::size_t contacts_of(const problem& p);

/// True for beams without beds: between places where something acts or changes, which are nodes, elements are
/// exact, so that a finer mesh has the same numbers; see reference/mesh-error.md.
[[nodiscard]] bool has_no_mesh_error(const problem& p);

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
[[nodiscard]] pair_reading reading_of(const pair_in<double>& p, double w, bool closed);

/// A state with its results. Pairs, supports, nodes and elements count from 0. Results that take long are
/// computed when they are first asked for.
class step_results {
 public:
  /// `p` and `s` must outlive this object.
  step_results(const problem& p, const structure_state& s);

  const problem& what;
  const structure_state& state;
  const load acting;  ///< the load of the state
  element_results elements;
  std::vector<double> reactions;    ///< [supports]
  std::vector<pair_reading> pairs;  ///< [pairs]
  std::vector<pair_reading> held;   ///< of the beds' fixed nodes, see bed::held, bed after bed

  /// See ranges_of.
  [[nodiscard]] const std::vector<value_range>& ranges() const;
  /// See stresses_of.
  [[nodiscard]] const element_results& stresses() const;
  /// The lines of a beam; empty for other structures.
  [[nodiscard]] std::optional<beam_lines> lines() const;

  /// The pair with the largest contact force; empty if no force is positive.
  [[nodiscard]] std::optional<std::size_t> hardest_pair() const;
  /// The support with the largest force and, if others have forces of the other sign, the largest of these.
  /// Moments on supports do not count.
  [[nodiscard]] std::vector<std::size_t> hardest_supports() const;

 private:
  mutable std::optional<std::vector<value_range>> ranges_;
  mutable std::optional<element_results> stresses_;
};

/// True for a support of a slope, or of a rotation of a matrix, whose reaction is a moment.
[[nodiscard]] bool is_turning(const problem& p, const support& s);

/// The sums of the upward forces on a structure, which add up to 0 in equilibrium, except for rounding.
struct force_balance {
  double loads, reactions, contact;
};
/// Empty for a matrix, which has no upward direction.
[[nodiscard]] std::optional<force_balance> balance_of(const step_results& r);

/// The contact of a bed with the structure.
struct bed_reading {
  value_range pressure;  ///< force divided by tributary length or area, at the bed's nodes
  double force = 0.0;    ///< the sum of the contact forces of its pairs
  double contact = 0.0;  ///< the tributary lengths or areas of the pairs in contact, added up
};
[[nodiscard]] std::vector<bed_reading> beds_in(const step_results& r);

/// The pressure of the beds at each node: force divided by tributary length or area [nodes].
[[nodiscard]] std::vector<double> bed_pressure(const step_results& r);

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
[[nodiscard]] std::string_view places_of_extremes(const model& m);

/// A place in words: "node 9, x = 4", "x = 4.31", "node 9, (1, 0.5)" or "dof 185.3".
[[nodiscard]] std::string place_words(const model& m, const placed_value& at);

}  // namespace contct
