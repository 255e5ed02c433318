#include "contct/certify/true_system.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contct/certify/true_kinds.hpp"

namespace contct::certify {
namespace {

true_beam truly(const beam& b) {
  return true_beam(b);
}
true_plate truly(const plate& p) {
  return true_plate(p);
}
true_matrix truly(const assembled& a) {
  return true_matrix(a);
}

template <class Kind>
void add_pairs(const problem& p, const Kind& kind, true_system& t) {
  for (const contact_pair& c : p.pairs)
    t.pairs.push_back(
        {c.node * dofs_per_node(p.geometry), c.surface, long_decimal(c.face), long_decimal(c.stiffness)});
  if (p.beds.empty()) return;
  const long_vector shares = kind.shares();
  for (const bed& b : p.beds)
    for (std::size_t i = b.first_pair; i < b.first_pair + b.share.size(); ++i)
      t.pairs[i].stiffness = long_decimal(b.modulus) * shares[p.pairs[i].node];
  for (const bed& b : p.beds) {
    if (b.face.empty()) continue;
    std::vector<int> nodes;
    for (std::size_t i = 0; i < b.share.size(); ++i) nodes.push_back(p.pairs[b.first_pair + i].node);
    const long_vector faces = kind.faces_at(nodes, b.face);
    for (std::size_t i = 0; i < faces.size(); ++i) t.pairs[b.first_pair + i].face = faces[i];
  }
}

/// Do these loads add up to 0?
bool cancel(std::span<const distributed_load* const> loads) {
  std::vector<std::vector<double>> coefficients;
  const auto add = [&](std::span<const double> polynomial) {
    coefficients.resize(std::max(coefficients.size(), polynomial.size()));
    for (std::size_t i = 0; i < polynomial.size(); ++i) coefficients[i].push_back(polynomial[i]);
  };
  for (const distributed_load* d : loads) {
    if (d->parts.empty()) add(d->polynomial);
    for (const std::vector<double>& part : d->parts) add(part);
  }
  return std::ranges::all_of(coefficients,
                             [](const auto& parts) { return numeric::decimal_sum(parts) == 0.0; });
}

/// The loads that act: none on elements where several of them together are 0.
load without_what_cancels(const load& l, int elements) {
  if (l.distributed.size() < 2) return l;
  std::vector<std::vector<const distributed_load*>> on(elements);
  for (const distributed_load& d : l.distributed)
    for_each_loaded_element({{}, {d}}, elements,
                            [&](int e, const auto& /*polynomial*/) { on[e].push_back(&d); });
  std::vector<char> loaded(elements, 1);
  for (int e = 0; e < elements; ++e)
    loaded[e] = e > 0 && on[e] == on[e - 1] ? loaded[e - 1] : on[e].size() > 1 && cancel(on[e]) ? 0 : 1;
  if (std::ranges::find(loaded, 0) == loaded.end()) return l;
  load left = l;
  left.distributed.clear();
  for (int e = 0; e < elements; ++e)
    for (const distributed_load* d : on[e])
      if (loaded[e] != 0) left.distributed.push_back({d->polynomial, {e}, d->parts});
  return left;
}

template <class Kind>
true_loads loads_of_step(const problem& p, const Kind& kind, int step) {
  const std::size_t n = dofs(p.geometry);
  const int per_node = dofs_per_node(p.geometry);
  true_loads f{step, long_vector(n), std::vector<double>(n, 0.0), long_vector(n)};
  const load l = without_what_cancels(p.steps[step - 1], elements(p.geometry));
  for (const auto& [dof, values] : point_loads_at(l, per_node)) {
    f.force[dof] = numeric::decimal_sum(values);
    f.size[dof] = std::abs(f.force[dof].hi);
  }
  kind.add_distributed(l, f);
  for (const prescribed_displacement& g : l.settlements)
    f.settlement[g.node * per_node + g.dof] += long_decimal(g.value);
  return f;
}

/// K, with the elastic supports.
template <class Kind>
void assemble(const problem& p, const Kind& kind, true_system& t) {
  const int per_node = dofs_per_node(p.geometry);
  sparse_rows rows(t.dofs());
  kind.assemble(rows);
  for (const support& s : p.supports)
    if (const int dof = s.node * per_node + s.dof; !s.fixed) rows.at(dof, dof) += long_decimal(s.spring);
  for (int dof = 0; dof < static_cast<int>(t.dofs()); ++dof) t.diagonal.push_back(rows.at(dof, dof));
  t.k = rows.packed();
}

template <class Kind>
void fill(const problem& p, const Kind& kind, true_system& t) {
  const std::size_t n = dofs(p.geometry);
  const int per_node = dofs_per_node(p.geometry);
  t.fixed.assign(n, 0);
  for (const support& s : p.supports)
    if (s.fixed) t.fixed[s.node * per_node + s.dof] = 1;
  assemble(p, kind, t);
  for (int dof = 0; dof < static_cast<int>(n); ++dof) {
    t.root.push_back(std::sqrt(t.diagonal[dof].hi) * (1 + 0x1p-50));
    t.deflects.push_back(dof % per_node == 0 ? 1 : 0);
  }
  t.span = kind.span();
  t.least_product = kind.least_product();
  add_pairs(p, kind, t);
  t.loads = [&p, kind](int step) { return loads_of_step(p, kind, step); };
  t.element_values = [&p, kind](int step, std::span<const double_double> u) {
    return kind.values(without_what_cancels(p.steps[step - 1], elements(p.geometry)), u);
  };
}

}  // namespace

void true_system::add_product(std::span<const double_double> u, std::span<double_double> sum,
                              std::span<double> sizes) const {
  for (std::size_t dof = 0; dof < dofs(); ++dof) {
    double_double of_row = sum[dof];
    double size = 0.0;
    for (std::size_t at = k.starts[dof]; at < k.starts[dof + 1]; ++at) {
      const int column = k.columns[at];
      of_row += k.values[at] * u[column];
      if (!sizes.empty()) size += root[column] * std::abs(u[column].hi);
    }
    sum[dof] = of_row;
    if (!sizes.empty()) sizes[dof] += root[dof] * size;
  }
}

true_system true_system_of(const problem& p) {
  true_system t;
  std::visit([&](const auto& geometry) { fill(p, truly(geometry), t); }, p.geometry.kind);
  return t;
}

}  // namespace contct::certify
