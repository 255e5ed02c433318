#include "contct/structure/problem.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "contct/numeric/rational.hpp"
#include "contct/structure/elements.hpp"
#include "contct/structure/rigid_shape.hpp"

namespace contct::structure {
namespace {

/// The elements that meet at a node, one to four.
std::vector<int> elements_around(const plate& p, int node) {
  const int i = node % p.columns();
  const int j = node / p.columns();
  std::vector<int> around;
  for (int row = std::max(j - 1, 0); row <= std::min(j, p.rows() - 2); ++row)
    for (int column = std::max(i - 1, 0); column <= std::min(i, p.columns() - 2); ++column)
      around.push_back(row * (p.columns() - 1) + column);
  return around;
}

/// What the elements beside a dof need there, beyond the loads on them.
need_of_elements needs(const beam& b, const load& l, std::span<const double> u) {
  return [last = b.elements(), forces = beam_elements<double>(b).end_forces(l, u)](int node, int dof) {
    const std::size_t left = dof == 0 ? 0 : 2;
    double need = 0.0;
    if (node < last) need += dof == 0 ? forces[node][left] : -forces[node][left];
    if (node > 0) need += dof == 0 ? -forces[node - 1][left + 1] : forces[node - 1][left + 1];
    return need;
  };
}

need_of_elements needs(const plate& p, const load& l, std::span<const double> u) {
  const plate_elements<double> elements(p);
  return [&p, u, elements, pressure = elements.pressures(l)](int node, int dof) {
    double need = 0.0;
    for (const int e : elements_around(p, node)) {
      const std::array<int, 4> nodes_of_e = p.corners_of(e);
      const auto place = std::ranges::find(nodes_of_e, node) - nodes_of_e.begin();
      const std::size_t own = 3 * place + dof;
      need += elements.forces(e, u)[own];
      need -= pressure[e].value * elements.unit_pressure_on(e)[own];
    }
    return need;
  };
}

need_of_elements needs(const assembled& a, const load& /*l*/, std::span<const double> u) {
  return [all = a.stiffness.times(u)](int dof, int /*of_node*/) { return static_cast<double>(all[dof]); };
}

template <class Kind>
std::vector<rigid_row> rigid_rows_of(const Kind& kind) {
  const rigid_shape<double> shape(kind);
  std::vector<rigid_row> rows;
  rows.reserve(kind.dofs());
  for (int dof = 0; dof < kind.dofs(); ++dof) {
    const auto [up, along_x, along_y] = shape.row_of(dof);
    rows.push_back({up, along_x, along_y});
  }
  return rows;
}

template <class Kind>
linear_structure build_of_elements(const model& m, const Kind& kind, std::span<const support> supports,
                                   std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = Kind::dofs_per_node;
  s.stiffness = band_matrix(kind.dofs(), subdiagonals(m));
  s.rows = rows_in_band(m);
  for_each_stiffness(elements_of<double>(kind), [&s](int e, const auto& dofs, const auto& own) {
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        add_to_band(s.stiffness.band(), s.row_of(dofs[i]), s.row_of(dofs[j]), own[i][j], e);
  });
  s.rigid_rows = rigid_rows_of(kind);
  s.rigid_motions = Kind::dofs_per_node;  // up, and a turn for each slope
  s.truth = std::make_shared<rigid_truth>(kind);
  put_on_supports(s, supports, std::move(pairs));
  return s;
}

element_results table_of(const beam& b, const load& l, std::span<const double> u) {
  element_results r{{"shear", "moment"}, 2, {}};
  for (const auto& of_element : beam_elements<double>(b).end_forces(l, u))
    r.values.insert(r.values.end(), of_element.begin(), of_element.end());
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

template <class Kind>
resultant sum_of_loads(const Kind& kind, const load& l) {
  return rigid_truth(kind).resultant_of(l);
}

resultant sum_of_loads(const assembled& /*a*/, const load& l) {
  numeric::rational sum;
  for (const point_load& p : l.points) sum += numeric::decimal_of(p.value);
  return {numeric::rounded(sum), {}};
}

}  // namespace

/// Nodes are numbered along the shorter side: the numbers of neighbours then lie closest to each other.
std::vector<int> rows_in_band(const model& m) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) return a->rows;
  const auto* const of_plate = std::get_if<plate>(&m.kind);
  if (of_plate == nullptr || of_plate->columns() <= of_plate->rows()) return {};
  const plate& p = *of_plate;
  std::vector<int> rows;
  rows.reserve(p.dofs());
  for (int j = 0; j < p.rows(); ++j)
    for (int i = 0; i < p.columns(); ++i)
      for (int d = 0; d < 3; ++d) rows.push_back(3 * (i * p.rows() + j) + d);
  return rows;
}

int subdiagonals(const model& m) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) return subdiagonals_of(a->stiffness, a->rows);
  if (const auto* p = std::get_if<plate>(&m.kind)) return 3 * (std::min(p->columns(), p->rows()) + 1) + 2;
  return 3;
}

linear_structure build(const model& m, std::span<const support> supports, std::vector<contact_pair> pairs) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) return build(*a, supports, std::move(pairs));
  if (const auto* p = std::get_if<plate>(&m.kind))
    return build_of_elements(m, *p, supports, std::move(pairs));
  return build_of_elements(m, std::get<beam>(m.kind), supports, std::move(pairs));
}

void add_consistent_loads(const model& m, const load& l, std::span<double> f) {
  add_point_loads(l, dofs_per_node(m), f);
  const auto add = [&](const auto& elements) {
    elements.for_each_work(l, [&](int /*e*/, const auto& work) {
      for (std::size_t i = 0; i < work.dofs.size(); ++i) f[work.dofs[i]] += work.force[i];
    });
  };
  std::visit([&](const auto& kind) { add(elements_of<double>(kind)); }, m.kind);
}

std::vector<double> tributary_shares(const model& m) {
  if (const auto* a = std::get_if<assembled>(&m.kind))
    throw std::invalid_argument(a->name + ": a matrix knows no lengths or areas");
  return std::visit([](const auto& kind) { return elements_of<double>(kind).shares(); }, m.kind);
}

std::vector<element_forces> forces_in_elements(const beam& b, const load& l, std::span<const double> u) {
  std::vector<element_forces> forces;
  for (const auto& [v1, v2, m1, m2] : beam_elements<double>(b).end_forces(l, u))
    forces.push_back({{v1, v2}, {m1, m2}});
  return forces;
}

std::vector<corner_moments> moments_in_elements(const plate& p, std::span<const double> u) {
  const plate_elements<double> elements(p);
  std::vector<corner_moments> moments;
  moments.reserve(p.elements());
  for (int e = 0; e < p.elements(); ++e) {
    const auto [mx, my, mxy] = elements.moments(e, u);
    moments.push_back({mx, my, mxy});
  }
  return moments;
}

std::vector<double> reactions(const model& m, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  const need_of_elements need = std::visit([&](const auto& kind) { return needs(kind, l, u); }, m.kind);
  return reactions_of(supports, l, u, dofs_per_node(m), need);
}

element_results results_in_elements(const model& m, const load& l, std::span<const double> u) {
  return std::visit([&](const auto& kind) { return table_of(kind, l, u); }, m.kind);
}

resultant resultant_of(const model& m, const load& l) {
  return std::visit([&](const auto& kind) { return sum_of_loads(kind, l); }, m.kind);
}

}  // namespace contct::structure
