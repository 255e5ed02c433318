#include "contct/write/input_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "contct/write/page_table.hpp"
#include "contct/write/step_results.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

/// "7", or "2..9".
std::string range_words(int first, int last) {
  return first == last ? fmt::format("{}", first) : fmt::format("{}..{}", first, last);
}

/// One length, or from the least to the largest: equal as far as the differences of coordinates are.
json length_words(std::span<const double> x, int first, int last) {
  double least = x[first + 1] - x[first];
  double most = least;
  for (int e = first + 1; e < last; ++e) {
    least = std::min(least, x[e + 1] - x[e]);
    most = std::max(most, x[e + 1] - x[e]);
  }
  if (most - least <= 1e-9 * most) return most;
  return fmt::format("{:.6g} to {:.6g}", least, most);
}

page_table structure_table(const problem& p, const beam& b) {
  const std::string length = in_unit(p.units, 0, 1);
  page_table t("Beam", {"Elements", "From x" + length, "to x" + length, "EI" + in_unit(p.units, 1, 2),
                        "Length of each" + length});
  for (int first = 0, last = 0; first < b.elements(); first = last) {
    while (last < b.elements() && b.EI[last] == b.EI[first]) ++last;
    t.add({range_words(first + 1, last), b.x[first], b.x[last], b.EI[first], length_words(b.x, first, last)});
  }
  return t;
}

page_table structure_table(const problem& p, const plate& s) {
  const std::string length = in_unit(p.units, 0, 1);
  page_table t("Plate", {"Quantity", "Value", "From" + length, "to" + length, "Distance" + length});
  t.add({"D" + in_unit(p.units, 1, 1), s.D, nullptr, nullptr, nullptr});
  t.add({"Poisson's ratio", s.nu, nullptr, nullptr, nullptr});
  const auto lines = [&](const char* name, const std::vector<double>& x) {
    t.add({name, x.size(), x.front(), x.back(), length_words(x, 0, static_cast<int>(x.size()) - 1)});
  };
  lines("Grid lines along x", s.x);
  lines("Grid lines along y", s.y);
  return t;
}

page_table structure_table(const problem& /*p*/, const assembled& a) {
  page_table t("Structure from a matrix", {"Quantity", "Value"});
  t.add({"Stiffness matrix", a.name});
  t.add({"Dofs", a.dofs()});
  return t;
}

/// What holds a node: for each of its dofs null, "fixed", or the stiffness of its springs.
std::map<int, json> held_nodes(const problem& p) {
  std::map<int, json> held;
  for (const support& s : p.supports) {
    json& cells = held.try_emplace(s.node, json(dofs_per_node(p.geometry), nullptr)).first->second;
    json& cell = cells[s.dof];
    if (s.fixed) {
      cell = "fixed";
    } else if (!cell.is_string()) {
      cell = s.spring + (cell.is_null() ? 0.0 : cell.get<double>());
    }
  }
  return held;
}

/// Neighbouring nodes of a beam that are held alike are one row.
page_table support_table(const problem& p) {
  std::vector<std::string> head = place_head(p);
  const auto names = dof_names(p.geometry);
  for (int dof = 0; dof < std::ssize(names); ++dof) {
    const std::string unit = force_unit(p, dof);
    const std::string per = unit_words(p.units, 1, dof == 0 ? -1 : 1);
    head.push_back(unit.empty() ? std::string(names[dof]) : fmt::format("{} [{}]", names[dof], per));
  }
  page_table t("Supports: fixed, or the stiffness of a spring", head);
  const std::map<int, json> held = held_nodes(p);
  const bool on_a_beam = std::holds_alternative<beam>(p.geometry.kind);
  for (auto first = held.begin(); first != held.end();) {
    auto last = first;
    auto next = std::next(first);
    while (on_a_beam && next != held.end() && next->first == last->first + 1 && next->second == first->second)
      last = next++;
    json cells = place_cells(p, first->first);
    if (last != first) {
      cells[0] = range_words(first->first + 1, last->first + 1);
      cells[1] =
          fmt::format("{:.6g} to {:.6g}", cells[1].get<double>(), place_of_node(p.geometry, last->first).x);
    }
    t.add(joined_cells(std::move(cells), first->second));
    first = next;
  }
  return t;
}

page_table pair_table(const problem& p) {
  std::vector<char> of_bed(p.pairs.size(), 0);
  for (const bed& b : p.beds)
    for (std::size_t i = 0; i < b.share.size(); ++i) of_bed[b.first_pair + i] = 1;
  std::vector<std::string> head = joined_heads({"Pair"}, place_head(p));
  page_table t(p.beds.empty() ? "Candidate pairs" : "Candidate pairs beside those of beds",
               joined_heads(head, {"Surface", "Face" + in_unit(p.units, 0, 1),
                                   "Stiffness" + in_unit(p.units, 1, -1), "At the start"}));
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const contact_pair& at = p.pairs[i];
    if (of_bed[i] != 0) continue;
    const json more = {surface_name(at.surface), at.face, at.stiffness,
                       at.closed ? "in contact" : "separated"};
    t.add(joined_cells(joined_cells({std::to_string(i + 1)}, place_cells(p, at.node)), more));
  }
  return t;
}

/// The range of a coordinate, or of faces: one number where it is one.
template <class Value>
json range_of(std::span<const contact_pair> pairs, Value value) {
  double least = value(pairs.front());
  double most = least;
  for (const contact_pair& at : pairs) {
    least = std::min(least, value(at));
    most = std::max(most, value(at));
  }
  if (least == most) return least;
  return fmt::format("{:.6g} to {:.6g}", least, most);
}

page_table bed_table(const problem& p) {
  const bool of_plate = std::holds_alternative<plate>(p.geometry.kind);
  const std::string length = in_unit(p.units, 0, 1);
  std::vector<std::string> head = {"Pairs", "Number", "x" + length};
  if (of_plate) head.push_back("y" + length);
  page_table t("Beds", joined_heads(head, {"Surface", "Face" + length,
                                           "Modulus" + in_unit(p.units, 1, of_plate ? -3 : -2)}));
  for (const bed& b : p.beds) {
    const auto pairs = std::span(p.pairs).subspan(b.first_pair, b.share.size());
    if (pairs.empty()) continue;
    const auto at = [&](const contact_pair& c) { return place_of_node(p.geometry, c.node); };
    const int first = static_cast<int>(b.first_pair) + 1;
    json row = {range_words(first, first + static_cast<int>(pairs.size()) - 1), pairs.size()};
    row.push_back(range_of(pairs, [&](const contact_pair& c) { return at(c).x; }));
    if (of_plate) row.push_back(range_of(pairs, [&](const contact_pair& c) { return at(c).y; }));
    row.push_back(surface_name(pairs.front().surface));
    row.push_back(range_of(pairs, [](const contact_pair& c) { return c.face; }));
    row.push_back(b.modulus);
    t.add(std::move(row));
  }
  return t;
}

/// "elements 2..9", "elements 1, 5, 7 and 12 more", "all elements".
std::string element_words(const std::vector<int>& elements) {
  constexpr std::size_t most = 6;
  if (elements.empty()) return "all elements";
  if (is_run(elements))
    return fmt::format("element{} {}", elements.size() == 1 ? "" : "s",
                       range_words(elements.front() + 1, elements.back() + 1));
  std::string words = "elements";
  for (std::size_t i = 0; i < std::min(most, elements.size()); ++i)
    words += fmt::format("{} {}", i == 0 ? "" : ",", elements[i] + 1);
  if (elements.size() > most) words += fmt::format(" and {} more", elements.size() - most);
  return words;
}

/// A number, or "a + b x + c x^2".
json polynomial_cell(const std::vector<double>& a) {
  if (a.size() == 1) return a[0];
  std::string words = fmt::format("{}", a[0]);
  for (std::size_t i = 1; i < a.size(); ++i)
    words +=
        fmt::format(" {} {} x{}", a[i] < 0 ? "-" : "+", std::abs(a[i]), i == 1 ? "" : fmt::format("^{}", i));
  return words;
}

void add_loads(const problem& p, std::size_t step, page_table& t) {
  const load& l = p.steps[step];
  const auto names = dof_names(p.geometry);
  const json start = {step_words(p, static_cast<int>(step) + 1)};
  const auto add = [&](std::string what, std::string where, json value) {
    t.add(joined_cells(start, json::array({std::move(what), std::move(where), std::move(value)})));
  };
  const bool of_plate = std::holds_alternative<plate>(p.geometry.kind);
  const std::string spread =
      of_plate ? "pressure" + in_unit(p.units, 1, -2) : "per length" + in_unit(p.units, 1, -1);
  const auto at = [&](int node) {
    if (std::holds_alternative<assembled>(p.geometry.kind)) return place_words(p.geometry, node);
    const place where = place_of_node(p.geometry, node);
    return place_words(p.geometry, {0.0, where.x, where.y, node});
  };
  for (const distributed_load& d : l.distributed)
    add(spread, element_words(d.elements), polynomial_cell(d.polynomial));
  for (const point_load& f : l.points) add(names[f.dof] + force_unit(p, f.dof), at(f.node), f.value);
  for (const prescribed_displacement& s : l.settlements)
    add(fmt::format("settlement {}{}", names[s.dof],
                    is_length(p.geometry, s.dof) ? in_unit(p.units, 0, 1) : ""),
        at(s.node), s.value);
  if (l.distributed.empty() && l.points.empty() && l.settlements.empty()) add("nothing", "", nullptr);
}

}  // namespace

json input_tables(const problem& p, std::vector<std::string>& omissions) {
  json tables = json::array();
  std::visit([&](const auto& kind) { structure_table(p, kind).put_into(tables, omissions); },
             p.geometry.kind);
  support_table(p).put_into(tables, omissions);
  pair_table(p).put_into(tables, omissions);
  bed_table(p).put_into(tables, omissions);
  page_table loads("Loads and settlements: totals at the ends of steps", {"Step", "What", "Where", "Value"});
  for (std::size_t step = 0; step < p.steps.size(); ++step) add_loads(p, step, loads);
  loads.put_into(tables, omissions);
  return tables;
}

}  // namespace contct::write
