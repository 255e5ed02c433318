#include "contct/structure/problem.hpp"

#include <utility>

namespace contct::structure {
namespace {

element_results table_of(const beam& b, const load& l, std::span<const double> u) {
  element_results r{{"shear", "moment"}, 2, {}};
  for (const element_forces& e : forces_in_elements(b, l, u))
    r.values.insert(r.values.end(), {e.shear[0], e.shear[1], e.moment[0], e.moment[1]});
  return r;
}

element_results table_of(const plate& p, const load& /*l*/, std::span<const double> u) {
  element_results r{{"mx", "my", "mxy"}, 4, {}};
  for (const corner_moments& e : moments_in_elements(p, u))
    for (const auto& quantity : {e.mx, e.my, e.mxy})
      r.values.insert(r.values.end(), quantity.begin(), quantity.end());
  return r;
}

element_results table_of(const assembled& /*a*/, const load& /*l*/, std::span<const double> /*u*/) {
  return {};  // a matrix has no elements
}

/// Where a node is, as far as its slopes go: a beam's x, a plate's x and y.
std::array<double, 2> place_of(const beam& b, int node) {
  return {b.x[node], 0.0};
}

std::array<double, 2> place_of(const plate& p, int node) {
  return {p.x[node % p.columns()], p.y[node / p.columns()]};
}

std::array<double, 2> place_of(const assembled& /*a*/, int /*node*/) {
  return {};
}

}  // namespace

linear_structure build(const model& m, std::span<const support> supports, std::vector<contact_pair> pairs,
                       distributed::ranks* among) {
  if (const auto* p = std::get_if<plate>(&m.kind)) return build(*p, supports, std::move(pairs), among);
  return std::visit([&](const auto& kind) { return build(kind, supports, std::move(pairs)); }, m.kind);
}

void add_consistent_loads(const model& m, const load& l, std::span<double> f) {
  std::visit([&](const auto& kind) { add_consistent_loads(kind, l, f); }, m.kind);
}

std::vector<double> tributary_shares(const model& m) {
  return std::visit([](const auto& kind) { return tributary_shares(kind); }, m.kind);
}

std::vector<double> reactions(const model& m, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  return std::visit([&](const auto& kind) { return reactions(kind, l, supports, u); }, m.kind);
}

element_results results_in_elements(const model& m, const load& l, std::span<const double> u) {
  return std::visit([&](const auto& kind) { return table_of(kind, l, u); }, m.kind);
}

resultant resultant_of(const model& m, const load& l) {
  std::vector<double> f(dofs(m), 0.0);
  add_consistent_loads(m, l, f);  // a consistent vector has the same resultant as the load itself
  const std::size_t slopes = dofs_per_node(m) - 1;
  resultant r{0.0, std::vector<double>(slopes, 0.0)};
  for (int node = 0; node < nodes(m); ++node) {
    const auto at = std::visit([node](const auto& kind) { return place_of(kind, node); }, m.kind);
    const double* const own = &f[node * (slopes + 1)];
    r.force += own[0];
    for (std::size_t i = 0; i < slopes; ++i) r.moments[i] += own[0] * at[i] + own[i + 1];
  }
  return r;
}

}  // namespace contct::structure
