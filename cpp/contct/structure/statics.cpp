#include "contct/structure/statics.hpp"

#include "contct/kernel/call.hpp"
#include "contct/structure/equations.hpp"

namespace contct {
namespace {

/// The forces of the elements at each dof, less the loads on the elements [dofs]. K u would lose the digits
/// that a large rigid-body motion cancels.
template <class Kind>
std::vector<double> forces_of_elements(const Kind& kind, const load& l, std::span<const double> u) {
  std::vector<double> need(u.size());
  elements_of<double>(kind).add_needs(l, u, need);
  return need;
}

std::vector<double> forces_of_elements(const assembled& a, const load& /*l*/, std::span<const double> u) {
  const std::vector<long double> all = a.stiffness.times(u);
  return {all.begin(), all.end()};
}

/// equations::needed without pairs [dofs].
std::vector<double> needed_without_pairs(const model& m, const load& l,
                                         const std::vector<support_in<double>>& supports,
                                         std::span<const double> u) {
  auto points = sums_at_dofs<double>(l.points, u.size(), dofs_per_node(m));
  for (const auto& s : supports)  // on a fixed dof, the fixed support also carries the spring's force
    if (!s.fixed) points[s.dof] -= s.spring * u[s.dof];
  std::vector<double> need =
      std::visit([&](const auto& kind) { return forces_of_elements(kind, l, u); }, m.kind);
  for (std::size_t dof = 0; dof < need.size(); ++dof) need[dof] -= points[dof];
  return need;
}

}  // namespace

loads_in<double> nodal_loads(const model& m, const load& l) {
  return std::visit(
      [&](const auto& kind) {
        return loads_in_numbers(l, elements_of<double>(kind), kind.dofs(), kind.dofs_per_node);
      },
      m.kind);
}

namespace {

std::vector<pair_in<double>> moved_under(const problem& p, const load& l,
                                         const std::vector<contact_pair>& pairs) {
  const int per_node = dofs_per_node(p.geometry);
  std::vector<pair_in<double>> all = pairs_in<double>(pairs, per_node);
  if (l.moves.empty()) return all;
  return with_moved_faces(std::move(all), sums_at_dofs<double>(l.moves, dofs(p.geometry), per_node));
}

}  // namespace

std::vector<pair_in<double>> pairs_under(const problem& p, const load& l) {
  return moved_under(p, l, p.pairs);
}

std::vector<pair_in<double>> held_under(const problem& p, const load& l) {
  std::vector<contact_pair> held;
  for (const bed& b : p.beds) held.insert(held.end(), b.held.begin(), b.held.end());
  return held.empty() ? std::vector<pair_in<double>>() : moved_under(p, l, held);
}

statics<double> statics_of(const problem& p, const load& l, std::span<const double> u,
                           std::span<const int> isep, statics<double> known) {
  const std::vector<pair_in<double>> pairs = pairs_under(p, l);
  std::vector<double> forces;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    forces.push_back(force_of(pairs[i], pairs[i].seen_in(u), isep[i] == in_contact));
  if (known.reactions.empty()) {
    const auto supports = supports_in<double>(p.supports, dofs_per_node(p.geometry));
    std::vector<double> needed = needed_without_pairs(p.geometry, l, supports, u);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (forces[i] != 0.0) pairs[i].add_to(needed, pairs[i].surface * forces[i]);
    for (const pair_in<double>& p_held : held_under(p, l)) equations<double>::add_pressing(p_held, u, needed);
    known.reactions.reserve(supports.size());
    for (const auto& support : supports)
      known.reactions.push_back(support.force(u, [&](int dof) { return needed[dof]; }));
  }
  if (known.pair_forces.empty()) known.pair_forces = std::move(forces);
  if (known.element_values.empty()) known.element_values = results_in_elements(p.geometry, l, u).values;
  return known;
}

element_results results_in_elements(const model& m, const load& l, std::span<const double> u) {
  return with_names(
      m, std::visit([&](const auto& kind) { return elements_of<double>(kind).values(l, u); }, m.kind));
}

element_results with_names(const model& m, std::vector<double> element_values) {
  return std::visit(
      [&](const auto& kind) {
        using elements = decltype(elements_of<double>(kind));
        return element_results{elements::names(), elements::places, std::move(element_values)};
      },
      m.kind);
}

}  // namespace contct
