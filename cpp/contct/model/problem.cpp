#include "contct/model/problem.hpp"

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "contct/model/elements.hpp"
#include "contct/number/rational.hpp"

namespace contct {
namespace {

void add_point_loads(const load& l, int dofs_per_node, std::span<double> f) {
  for (const auto& [dof, values] : by_dof(l.points, dofs_per_node)) f[dof] += sum_of<double>(values);
}

template <class Kind>
std::vector<double> needs_of(const Kind& kind, const load& l, std::span<const double> u) {
  std::vector<double> need(u.size());
  elements_of<double>(kind).add_needs(l, u, need);
  return need;
}

std::vector<double> needs_of(const assembled& a, const load& /*l*/, std::span<const double> u) {
  const std::vector<long double> all = a.stiffness.times(u);
  return {all.begin(), all.end()};
}

template <class Kind>
linear_structure build_kind(const model& m, const Kind& kind, std::span<const support> supports,
                            std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = Kind::dofs_per_node;
  s.stiffness = band_matrix(kind.dofs(), subdiagonals(m));
  s.rows = rows_in_band(m);
  for_each_stiffness(elements_of<double>(kind), [&s](int e, const auto& dofs, const auto& own) {
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        if (!std::isfinite(own[i][j]))
          throw std::invalid_argument("the stiffness of element " + std::to_string(e + 1) +
                                      " is not a finite number");
        s.stiffness.band().add(s.row_of(dofs[i]), s.row_of(dofs[j]), own[i][j]);
      }
  });
  s.rigid_rows = rigid_rows_of(kind);
  s.truth = std::make_shared<rigid_truth>(kind);
  s.rigid_motions = s.truth->motions();
  put_on_supports(s, supports, std::move(pairs));
  s.on_supports = s.held_by_supports();
  return s;
}

linear_structure build_kind(const model& /*m*/, const assembled& a, std::span<const support> supports,
                            std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = assembled::dofs_per_node;
  if (a.as_band) {
    s.rows = a.rows;
    s.stiffness = band_of(a.stiffness, a.rows);
  } else {
    s.stiffness = columns_of(a.stiffness);
  }
  s.rigid_rows.assign(a.dofs(), rigid_row{});
  put_on_supports(s, supports, std::move(pairs));
  for (int dof = 0; dof < s.dofs(); ++dof)
    if (!(s.stiffness.diagonal(s.row_of(dof)) > 0.0)) refuse_without_stiffness(a, dof);

  // find_free_motions finds only motions that the supports leave free, so no dof counts as supported below.
  free_motions motions;
  try {
    motions = find_free_motions(s.stiffness, a.free_motions, [&](std::span<const double> in_rows) {
      std::vector<double> u(in_rows.size());
      for (std::size_t dof = 0; dof < u.size(); ++dof)
        u[dof] = s.fixed[dof] != 0 ? 0.0 : in_rows[s.row_of(dof)];
      return a.stiffness.doubt(u);
    });
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(a.name + ": " + e.what());
  }
  s.rigid_motions = motions.count;
  s.rigid_rounding = motions.rounding;
  s.rigid_stiffness = motions.stiffness;
  s.supported_dofs.clear();
  for (std::size_t dof = 0; dof < s.fixed.size(); ++dof)
    if (s.fixed[dof] == 0) s.rigid_rows[dof] = motions.rows[s.row_of(dof)];
  // A matrix does not show which dofs are deflections: the dofs of pairs count, or without pairs all dofs.
  s.lengths.assign(a.dofs(), s.pairs.empty() ? 1 : 0);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    s.lengths[s.dof_of_pair(i)] = 1;
    if (const int other = s.other_of_pair(i); other >= 0) s.lengths[other] = 1;
  }
  return s;
}

std::string unit_at(const assembled& a, const problem& p, std::string_view quantity, int dof) {
  const placed_dof at = dof >= 0 && a.places.known() ? a.places.dofs[dof] : placed_dof{};
  const bool has_pair = std::any_of(p.pairs.begin(), p.pairs.end(), [dof](const contact_pair& c) {
    return c.node == dof || (dof >= 0 && c.other == dof);
  });
  if (at.is_length() || has_pair)
    return on_one_line(" " + (quantity == "w" ? p.units.length : p.units.force));
  const bool turns = at.direction != 0;
  return turns && quantity == "force" ? on_one_line(" " + p.units.force + " " + p.units.length) : "";
}

}  // namespace

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
  return std::visit([&](const auto& kind) { return build_kind(m, kind, supports, std::move(pairs)); },
                    m.kind);
}

void refuse_without_stiffness(const assembled& a, int dof) {
  throw std::invalid_argument(a.name + ": dof " + a.label_of(dof) +
                              ": found a row of zeros and no support; allowed: a matrix that is positive "
                              "semidefinite, with a positive entry on the diagonal of each dof that no "
                              "support holds. Omit the dof from the matrix, or add a [[support]]");
}

void add_consistent_loads(const model& m, const load& l, std::span<double> f) {
  add_point_loads(l, dofs_per_node(m), f);
  const auto add = [&f](int /*e*/, const auto& work) {
    for (std::size_t i = 0; i < work.dofs.size(); ++i) f[work.dofs[i]] += work.force[i];
  };
  std::visit([&](const auto& kind) { elements_of<double>(kind).for_each_work(l, add); }, m.kind);
}

std::vector<double> tributary_shares(const model& m) {
  if (const auto* a = std::get_if<assembled>(&m.kind))
    throw std::invalid_argument(a->name + ": a matrix has no lengths or areas");
  return std::visit([](const auto& kind) { return elements_of<double>(kind).shares(); }, m.kind);
}

std::vector<double> reactions(const model& m, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  const int per_node = dofs_per_node(m);
  const std::vector<double> need = std::visit([&](const auto& kind) { return needs_of(kind, l, u); }, m.kind);
  std::vector<double> points(u.size(), 0.0);
  add_point_loads(l, per_node, points);
  for (const support& s : supports)  // on a fixed dof, the fixed support also carries the spring's force
    if (!s.fixed) points[s.node * per_node + s.dof] -= s.spring * u[s.node * per_node + s.dof];
  std::vector<double> values;
  std::set<int> reacted;
  for (const support& s : supports) {
    const int dof = s.node * per_node + s.dof;
    if (!s.fixed) {
      values.push_back(-s.spring * u[dof]);
    } else {
      values.push_back(reacted.insert(dof).second ? need[dof] - points[dof] : 0.0);
    }
  }
  return values;
}

element_results results_in_elements(const model& m, const load& l, std::span<const double> u) {
  return std::visit(
      [&](const auto& kind) {
        const auto elements = elements_of<double>(kind);
        return element_results{elements.names(), elements.places, elements.values(l, u)};
      },
      m.kind);
}

std::string unit_words(const problem& p, std::string_view quantity, int dof) {
  const auto& [length, force] = p.units;
  if (length.empty()) return "";
  if (const auto* a = std::get_if<assembled>(&p.geometry.kind)) return unit_at(*a, p, quantity, dof);
  const bool flat = std::holds_alternative<plate>(p.geometry.kind);
  const auto is_one_of = [quantity](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), quantity) != names.end();
  };
  if (is_one_of({"theta", "wx", "wy"})) return "";
  if (is_one_of({"stress", "s1", "s2", "von_mises"})) return on_one_line(" " + force + "/" + length + "^2");
  if (quantity == "pressure") return on_one_line(" " + force + "/" + length + (flat ? "^2" : ""));
  if (quantity == "contact") return on_one_line(" " + length + (flat ? "^2" : ""));
  if (is_one_of({"mx", "my", "mxy"})) return on_one_line(" " + force + " " + length + "/" + length);
  if (quantity == "w") return " " + length;
  return " " + force + (quantity == "moment" ? " " + length : "");
}

std::vector<contact_pair> pairs_under(const problem& p, const load& l) {
  std::vector<contact_pair> pairs = p.pairs;
  std::map<int, double> moved;  // by node
  for (const face_move& m : l.moves) moved[m.node] += product_of<double>(m.value, m.factor);
  if (!moved.empty())
    for (contact_pair& c : pairs)
      if (const auto at = moved.find(c.node); at != moved.end()) c.face += at->second;
  return pairs;
}

resultant resultant_of(const model& m, const load& l) {
  if (const auto* const b = std::get_if<beam>(&m.kind)) return rigid_truth(*b).resultant_of(l);
  if (const auto* const p = std::get_if<plate>(&m.kind)) return rigid_truth(*p).resultant_of(l);
  rational sum;
  for (const point_load& p : l.points) sum += product_of<rational>(p.value, p.factor);
  return {contct::rounded(sum), {}};
}

}  // namespace contct
