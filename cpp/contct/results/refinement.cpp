// Estimates the effect of a finer mesh: halves every element of a problem, and compares the two results.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "contct/results/quantities.hpp"
#include "contct/structure/line.hpp"
#include "contct/structure/placed_loads.hpp"

namespace contct {
namespace {

/// Converts node and element numbers, from 0, between a coarse mesh and the mesh of half the element size.
struct halved_grid {
  explicit halved_grid(const model& m)
      : columns(std::holds_alternative<plate>(m.kind) ? std::get<plate>(m.kind).columns() : nodes(m)),
        rows(nodes(m) / columns) {}
  [[nodiscard]] int fine_columns() const { return 2 * columns - 1; }
  [[nodiscard]] int node(int coarse) const {
    return 2 * (coarse / columns) * fine_columns() + 2 * (coarse % columns);
  }
  /// The coarse nodes around a fine node: 2 on an edge, 4 inside an element, otherwise the node itself.
  [[nodiscard]] std::vector<int> around(int fine) const {
    const int i = fine % fine_columns();
    const int j = fine / fine_columns();
    std::vector<int> all;
    for (int row = j / 2; row <= (j + 1) / 2; ++row)
      for (int column = i / 2; column <= (i + 1) / 2; ++column) all.push_back(row * columns + column);
    return all;
  }
  [[nodiscard]] std::vector<int> parts_of(const std::vector<int>& elements) const {
    std::vector<int> all;
    for (const int e : elements) {
      for (int above = 0; above < std::min(rows, 2); ++above) {
        const int left = (2 * (e / (columns - 1)) + above) * (fine_columns() - 1) + 2 * (e % (columns - 1));
        all.insert(all.end(), {left, left + 1});
      }
    }
    return all;
  }
  int columns, rows;
};

/// Halves every interval of `x`, and records the halves as equal elements, because the middle is rounded.
void halve(std::vector<double>& x, std::vector<even_run>& runs) {
  for (std::size_t i = 1; i < x.size() && (i > 1 || runs.empty()); ++i) runs.push_back({x[i], 1});
  for (even_run& run : runs) run.elements *= 2;
  std::vector<double> fine = {x.front()};
  for (std::size_t i = 1; i < x.size(); ++i)
    fine.insert(fine.end(), {x[i - 1] + (x[i] - x[i - 1]) / 2, x[i]});
  x.swap(fine);
}

template <class Value>
void double_each(std::vector<Value>& of_elements) {
  std::vector<Value> fine;
  for (const Value& value : of_elements) fine.insert(fine.end(), 2, value);
  of_elements.swap(fine);
}

void halve(beam& b) {
  halve(b.x, b.runs);
  for (const element_key& key : element_keys) double_each(b.*key.values);
  double_each(b.sections);
  for (int& node : b.hinges) node *= 2;
}

void halve(plate& p) {
  halve(p.x, p.x_runs);
  halve(p.y, p.y_runs);
}

void halve(assembled& a) {
  throw std::invalid_argument(
      "--refine: found a structure given by its matrix, " + a.name +
      "; allowed: [beam] and [plate]. Write the matrix of a finer mesh with the program that wrote this one, "
      "and compare the two results");
}

std::vector<char> fixed_in(const problem& p, int dof) {
  std::vector<char> fixed(nodes(p.geometry));
  for (const support& s : p.supports)
    if (s.fixed && s.dof == dof) fixed[s.node] = 1;
  return fixed;
}

void add_supports(const problem& p, const halved_grid& grid, int dof, problem& fine) {
  const std::vector<char> fixed = fixed_in(p, dof);
  for (int node = 0; node < nodes(fine.geometry); ++node) {
    const std::vector<int> around = grid.around(node);
    const auto share = 1.0 / static_cast<double>(around.size());
    if (share == 1.0 || !std::ranges::all_of(around, [&](int n) { return fixed[n] != 0; })) continue;
    fine.supports.push_back({node, dof, true});
    for (std::size_t step = 0; step < p.steps.size(); ++step) {
      double mean = 0.0;
      for (const prescribed_displacement& g : p.steps[step].settlements)
        if (g.dof == dof && std::ranges::count(around, g.node) > 0)
          mean += share * product_of<double>(g.value, g.factor);
      if (mean != 0.0) fine.steps[step].settlements.push_back({node, dof, mean});
    }
  }
}

/// Where bed `b` acts on the finer mesh: its parts or, of a bed by nodes, the half elements at each run of
/// nodes in a row.
std::vector<bed_part> parts_of(const bed& b, const halved_grid& grid, const model& fine) {
  std::vector<bed_part> all = b.parts;
  for (bed_part& part : all)
    for (auto* const places : {&part.from, &part.to})
      for (line_place& at : *places)
        if (at.point > 0) at.point *= 2;
  const auto corner = [&](int i, int j) {
    const int column = std::clamp(i, 0, grid.fine_columns() - 1);
    const int row = std::clamp(j, 0, 2 * grid.rows - 2);
    const place at = place_of_node(fine, row * grid.fine_columns() + column);
    std::array<line_place, 2> places = {at.x, at.y};
    places[0].point = column;
    places[1].point = row;
    return places;
  };
  for (std::size_t n = 0; n < b.nodes.size(); ++n) {
    const int i = b.nodes[n] % grid.columns;
    const int j = b.nodes[n] / grid.columns;
    if (n == 0 || i == 0 || b.nodes[n - 1] + 1 != b.nodes[n])
      all.push_back({corner(2 * i - 1, 2 * j - 1), {}, b.modulus});
    all.back().to = corner(2 * i + 1, 2 * j + 1);
  }
  return all;
}

/// Adds bed `b` of `p` to the finer problem. New faces are means of neighbours, or the polynomial's values.
void add_bed(const problem& p, const halved_grid& grid, const bed& b, problem& fine) {
  std::map<int, double> faces;
  for (std::size_t i = 0; i < b.share.size(); ++i)
    faces[p.pairs[b.first_pair + i].node] = p.pairs[b.first_pair + i].face;
  for (const contact_pair& at : b.held) faces[at.node] = at.face;
  const std::vector<char> fixed = fixed_in(fine, 0);
  bed made{b.modulus, {}, fine.pairs.size(), b.face, b.closed, {}, parts_of(b, grid, fine.geometry)};
  const bed_springs springs = springs_of(fine.geometry, made.parts);
  for (int node = 0; node < nodes(fine.geometry); ++node) {
    if (springs.share[node] == 0) continue;
    const std::vector<int> around = grid.around(node);
    const auto known = std::ranges::count_if(around, [&](int n) { return faces.contains(n); });
    if (known == 0) continue;  // a fixed node whose face, inside the structure, is not used
    double face = 0.0;
    for (const int n : around)
      if (faces.contains(n)) face += faces[n] / static_cast<double>(known);
    if (!b.face.empty())
      face = values_at<double>(std::get<beam>(fine.geometry.kind), b.face, std::vector{node}).front();
    const contact_pair pair{node, p.pairs[b.first_pair].surface, face, rounded(springs.stiffness[node]),
                            b.closed.value_or(true) && face == 0.0};
    (fixed[node] != 0 ? made.held : fine.pairs).push_back(pair);
    (fixed[node] != 0 ? made.held_share : made.share).push_back(rounded(springs.share[node]));
  }
  fine.beds.push_back(std::move(made));
}

/// Moves the faces of beds at new nodes by the mean of the moves at the bed's nodes around.
void add_moves(const problem& p, const halved_grid& grid, problem& fine) {
  const auto of_beds = [](const problem& of) {
    std::set<int> all;
    for (std::size_t i = contacts_of(of); i < of.pairs.size(); ++i) all.insert(of.pairs[i].node);
    for (const bed& b : of.beds)
      for (const contact_pair& at : b.held) all.insert(at.node);
    return all;
  };
  const std::set<int> known = of_beds(p);
  for (const int node : of_beds(fine)) {
    std::vector<int> around = grid.around(node);
    if (around.size() == 1) continue;
    std::erase_if(around, [&known](int n) { return !known.contains(n); });
    for (std::size_t step = 0; step < p.steps.size(); ++step)
      for (const face_move& m : p.steps[step].moves)
        if (std::ranges::count(around, m.node) > 0)
          fine.steps[step].moves.push_back(
              {node, m.dof, m.value / static_cast<double>(around.size()), m.factor});
  }
}

}  // namespace

problem refined(const problem& p) {
  const halved_grid grid(p.geometry);
  problem fine = p;
  std::visit([](auto& kind) { halve(kind); }, fine.geometry.kind);
  for (support& s : fine.supports) s.node = grid.node(s.node);
  for (load& l : fine.steps) {
    for (const auto values : nodal_values)
      for (nodal_value& at : l.*values) at.node = grid.node(at.node);
    for (distributed_load& d : l.distributed) d.elements = grid.parts_of(d.elements);
    for (placed_load& at : l.placed)
      for (line_place* const end : {&at.from, &at.to, &at.across.front(), &at.across.back()})
        if (end->point > 0) end->point *= 2;
  }
  if (std::holds_alternative<plate>(p.geometry.kind))
    for (int dof = 0; dof < plate::dofs_per_node; ++dof) add_supports(p, grid, dof, fine);
  fine.pairs.resize(contacts_of(p));
  for (contact_pair& pair : fine.pairs) pair.node = grid.node(pair.node);
  fine.beds.clear();
  for (const bed& b : p.beds) add_bed(p, grid, b, fine);
  add_moves(p, grid, fine);
  return fine;
}

void estimate_errors(std::vector<mesh_change>& by_first, const std::vector<mesh_change>& by_second) {
  constexpr double least = 0.3;  // below, an extreme may have no limit
  for (mesh_change& c : by_first) {
    const auto next = std::ranges::find(by_second, c.kind, &mesh_change::kind);
    if (next == by_second.end()) continue;
    c.order = c.change == next->change ? 0.0 : std::clamp(std::log2(c.change / next->change), -9.0, 9.0);
    if (std::max(c.change, next->change) <= 1e-9 * c.of) c.error = c.change + next->change;  // rounding
    if (!(*c.order >= least)) continue;
    const double ratio = std::exp2(std::clamp(*c.order, 0.6, 2.0));
    c.error = c.change + next->change * ratio / (ratio - 1);
  }
}

std::vector<mesh_change> changes_between(const run_result& coarse, const run_result& fine) {
  std::vector<mesh_change> all;
  std::size_t step = 0;
  const auto take = [&all, &step](std::string_view kind, double before, double now) {
    auto at = std::ranges::find(all, kind, &mesh_change::kind);
    if (at == all.end()) at = all.insert(all.end(), {kind});
    if (const double change = std::abs(now - before); change > at->change || at->step == 0) {
      at->change = change;
      at->step = static_cast<int>(step) + 1;
    }
    at->of = std::max(at->of, std::abs(now));
  };
  const problem& p = coarse.what;
  for (; step < p.steps.size(); ++step) {
    const structure_state& before = coarse.record.steps[step];
    const structure_state& now = fine.record.steps[step];
    const step_results a(p, before);
    const step_results b(fine.what, now);
    for (std::size_t i = 0; i < a.ranges().size(); ++i) {
      take(a.ranges()[i].name, a.ranges()[i].least.value, b.ranges()[i].least.value);
      take(a.ranges()[i].name, a.ranges()[i].most.value, b.ranges()[i].most.value);
    }
    // Numbers of entries that the finer mesh has too. The supports of plates are others; loads and gaps are
    // no results.
    const bool of_beam = std::holds_alternative<beam>(p.geometry.kind);
    for (const quantity_row* row : quantities_of(p)) {
      const list_row& list = list_of(row->where);
      if (list.count == nullptr || row->where == on::structure || (!of_beam && row->where == on::supports) ||
          (row->where == on::pairs && row->kind != quantity::force))
        continue;
      const std::vector<double> had = row->values(a);
      const std::vector<double> has = row->values(b);
      for (std::size_t i = 0; i < list.count(p); ++i)
        if (!std::isnan(had[i])) take(row->key, had[i], has[i]);
    }
  }
  return all;
}

}  // namespace contct
