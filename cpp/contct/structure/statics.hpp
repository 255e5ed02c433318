// The statics of a structure in any kind of number, each rule once: how faces move, which support gets a
// reaction, and the numbers of a state that follow from its displacements. gap_of and force_of are the law of
// a pair, equations::needed is the residual. `Number` is double, double_double or rational.
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "contct/structure/line.hpp"

namespace contct {

template <class Number>
[[nodiscard]] std::vector<support_in<Number>> supports_in(std::span<const support> supports,
                                                          int dofs_per_node) {
  std::vector<support_in<Number>> all;
  std::set<int> held;
  for (const support& s : supports) {
    const int dof = s.node * dofs_per_node + s.dof;
    all.push_back({dof, s.fixed, s.fixed ? Number(0) : number_of<Number>(s.spring),
                   !s.fixed || held.insert(dof).second});
  }
  return all;
}

template <class Number>
[[nodiscard]] std::vector<pair_in<Number>> pairs_in(std::span<const contact_pair> pairs, int dofs_per_node) {
  std::vector<pair_in<Number>> all;
  all.reserve(pairs.size());
  for (const contact_pair& c : pairs)
    all.push_back({c.node * dofs_per_node, c.surface, number_of<Number>(c.face),
                   number_of<Number>(c.stiffness), c.closed, c.other < 0 ? -1 : c.other * dofs_per_node});
  return all;
}

/// The sum of the values at each dof [dofs].
template <class Number>
[[nodiscard]] std::vector<Number> sums_at_dofs(std::span<const nodal_value> values, std::size_t dofs,
                                               int dofs_per_node) {
  std::map<int, std::vector<nodal_value>> at;
  for (const nodal_value& v : values) at[v.node * dofs_per_node + v.dof].push_back(v);
  std::vector<Number> sums(dofs);
  for (const auto& [dof, some] : at) sums[dof] = sum_of<Number>(some);
  return sums;
}

/// `pairs` with their faces moved by `moved`, the distances at each dof [dofs].
template <class Number, class Vector>
[[nodiscard]] std::vector<pair_in<Number>> with_moved_faces(std::vector<pair_in<Number>> pairs,
                                                            const Vector& moved) {
  for (pair_in<Number>& p : pairs) p.face += moved[p.dof];
  return pairs;
}

/// The consistent loads of `l` and its values at dofs. Loads on a matrix are forces at dofs. Point loads at
/// one dof add up to exactly 0 if their decimals do: 0.1, 0.2 and -0.3. Throws std::invalid_argument if a
/// distributed load on a plate is not constant.
[[nodiscard]] loads_in<double> nodal_loads(const model& m, const load& l);

/// The pairs of `p`, and those of all beds at fixed nodes, with the faces moved as `l` prescribes.
[[nodiscard]] std::vector<pair_in<double>> pairs_under(const problem& p, const load& l);
[[nodiscard]] std::vector<pair_in<double>> held_under(const problem& p, const load& l);

/// The numbers of a state that follow from its displacements.
template <class Number>
struct statics {
  std::vector<Number> pair_forces = {};  ///< see force_of [pairs]
  std::vector<Number> reactions = {};    ///< the force or moment of each support on the structure [supports]
  std::vector<Number> element_values = {};  ///< see element_results

  [[nodiscard]] bool any() const {
    return !pair_forces.empty() || !reactions.empty() || !element_values.empty();
  }
};

/// The numbers of a state with displacements `u` [dofs] and statuses `isep` [pairs] under load `l`. The force
/// of a pair on a fixed deflection is not part of a reaction. Lists that are not empty in `known` are kept.
[[nodiscard]] statics<double> statics_of(const problem& p, const load& l, std::span<const double> u,
                                         std::span<const int> isep, statics<double> known = {});

/// The results in every element, under displacement `u` [dofs] and load `l`.
[[nodiscard]] element_results results_in_elements(const model& m, const load& l, std::span<const double> u);
/// statics::element_values with their names.
[[nodiscard]] element_results with_names(const model& m, std::vector<double> element_values);

}  // namespace contct
