#include "contct/structure/problem.hpp"

#include <cmath>
#include <stdexcept>

#include "contct/number/rational.hpp"
#include "contct/structure/elements.hpp"
#include "contct/structure/statics.hpp"

namespace contct {
namespace {

template <class Kind>
linear_structure build_kind(const model& m, const Kind& kind, std::span<const support> supports,
                            const std::vector<contact_pair>& pairs) {
  linear_structure s;
  s.dofs_per_node = Kind::dofs_per_node;
  s.rows = rows_in_band(m);
  s.stiffness = [&] {
    band_matrix k(kind.dofs(), subdiagonals(m));
    for_each_stiffness(elements_of<double>(kind), [&](int e, const auto& dofs, const auto& own) {
      for (std::size_t i = 0; i < dofs.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j) {
          if (!std::isfinite(own[i][j]))
            throw std::invalid_argument("the stiffness of element " + std::to_string(e + 1) +
                                        " is not a finite number");
          k.add(s.row_of(dofs[i]), s.row_of(dofs[j]), own[i][j]);
        }
    });
    return k;
  }();
  s.rigid_rows = rigid_rows_of(kind);
  s.truth = std::make_shared<rigid_truth>(kind);
  s.rigid_motions = s.truth->motions();
  put_on_supports(s, supports, pairs_in<double>(pairs, s.dofs_per_node));
  s.on_supports = s.held_by_supports();
  return s;
}

linear_structure build_kind(const model& /*m*/, const assembled& a, std::span<const support> supports,
                            const std::vector<contact_pair>& pairs) {
  linear_structure s;
  s.dofs_per_node = assembled::dofs_per_node;
  if (a.as_band) {
    s.rows = a.rows;
    s.stiffness = {columns_of(a.stiffness, a.rows), subdiagonals_of(a.stiffness, a.rows)};
  } else {
    s.stiffness = columns_of(a.stiffness);
  }
  s.rigid_rows.assign(a.dofs(), rigid_row{});
  put_on_supports(s, supports, pairs_in<double>(pairs, s.dofs_per_node));
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
  for (const pair_in<double>& p : s.pairs)
    for (const int dof : {p.dof, p.other})
      if (dof >= 0) s.lengths[dof] = 1;
  return s;
}

/// The unit of a displacement or a force (`u`) at a dof of a matrix.
unit unit_at(const assembled& a, const problem& p, unit u, int dof) {
  const placed_dof at = dof >= 0 && a.places.known() ? a.places.dofs[dof] : placed_dof{};
  const bool has_pair = std::any_of(p.pairs.begin(), p.pairs.end(), [dof](const contact_pair& c) {
    return c.node == dof || (dof >= 0 && c.other == dof);
  });
  if (at.is_length() || has_pair) return u;
  const bool turns = at.direction != 0;
  return turns && u == unit::force ? unit::moment : unit::none;
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

linear_structure build(const model& m, std::span<const support> supports,
                       const std::vector<contact_pair>& pairs) {
  return std::visit([&](const auto& kind) { return build_kind(m, kind, supports, pairs); }, m.kind);
}

void refuse_without_stiffness(const assembled& a, int dof) {
  throw std::invalid_argument(a.name + ": dof " + a.label_of(dof) +
                              ": found a row of zeros and no support; allowed: a matrix that is positive "
                              "semidefinite, with a positive entry on the diagonal of each dof that no "
                              "support holds. Omit the dof from the matrix, or add a [[support]]");
}

std::vector<double> tributary_shares(const model& m) {
  if (const auto* a = std::get_if<assembled>(&m.kind))
    throw std::invalid_argument(a->name + ": a matrix has no lengths or areas");
  return std::visit([](const auto& kind) { return elements_of<double>(kind).shares(); }, m.kind);
}

std::vector<double> exact_shares(const model& m) {
  const auto shares =
      std::visit([](const auto& kind) { return elements_of<double_double>(kind).shares(); }, m.kind);
  std::vector<double> all;
  for (const double_double& share : shares) all.push_back(share.hi);
  return all;
}

std::string unit_name(const problem& p, unit u) {
  const auto& [length, force] = p.units;
  if (length.empty()) return "";
  const std::string extent = length + (std::holds_alternative<plate>(p.geometry.kind) ? "^2" : "");
  const std::string in_order[] = {"",
                                  length,
                                  force,
                                  force + " " + length,
                                  force + " " + length + "/" + length,
                                  force + "/" + length + "^2",
                                  force + "/" + extent,
                                  extent};
  return on_one_line(in_order[static_cast<std::size_t>(u)]);
}

std::string unit_words(const problem& p, unit u, int dof) {
  const auto* const a = std::get_if<assembled>(&p.geometry.kind);
  const std::string name = unit_name(p, a == nullptr ? u : unit_at(*a, p, u, dof));
  return name.empty() ? "" : " " + name;
}

resultant resultant_of(const model& m, const load& l) {
  if (const auto* const b = std::get_if<beam>(&m.kind)) return rigid_truth(*b).resultant_of(l);
  if (const auto* const p = std::get_if<plate>(&m.kind)) return rigid_truth(*p).resultant_of(l);
  rational sum;
  for (const point_load& p : l.points) sum += product_of<rational>(p.value, p.factor);
  return {contct::rounded(sum), {}};
}

}  // namespace contct
