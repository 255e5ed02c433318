#include "contct/write/run_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "contct/write/words.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

/// A table that grows by rows, of which it keeps the first.
class page_table {
 public:
  page_table(std::string title, std::vector<std::string> head)
      : title_(std::move(title)), head_(std::move(head)) {}

  void add(json row) {
    if (all_++ < most_rows) rows_.push_back(std::move(row));
  }
  /// These rows of `all`, chosen by the caller as `how` says.
  void choose(json rows, std::size_t all, std::string how) {
    rows_ = std::move(rows);
    all_ = all;
    how_ = std::move(how);
  }

  /// Nothing where there are no rows.
  void put_into(json& tables, std::vector<std::string>& omissions) const {
    if (all_ == 0) return;
    std::string title = title_;
    if (rows_.size() < all_) {
      const std::string cut = fmt::format("{} {} of {}", how_, rows_.size(), all_);
      title += fmt::format(" ({})", cut);
      omissions.push_back(fmt::format("{}: the table has the {} rows.", title_, cut));
    }
    tables.push_back({{"title", title}, {"head", head_}, {"rows", rows_}});
  }

 private:
  std::string title_, how_ = "first";
  std::vector<std::string> head_;
  json rows_ = json::array();
  std::size_t all_ = 0;
};

/// " [kN/m]", behind a heading.
std::string in_unit(const unit_labels& u, int force, int length) {
  const std::string words = unit_words(u, force, length);
  return words.empty() ? "" : fmt::format(" [{}]", words);
}

/// What acts at a dof, or what it moves by, has the power of length of its name: rotations count as none.
bool is_length(const model& m, int dof) {
  return dof == 0 && !std::holds_alternative<assembled>(m.kind);
}
std::string force_unit(const problem& p, int dof) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return "";
  return in_unit(p.units, 1, is_length(p.geometry, dof) ? 0 : 1);
}

/// "node", "x" and "y", as far as the structure has them.
std::vector<std::string> place_head(const problem& p) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return {"Dof"};
  std::vector<std::string> head = {"Node", "x" + in_unit(p.units, 0, 1)};
  if (std::holds_alternative<plate>(p.geometry.kind)) head.push_back("y" + in_unit(p.units, 0, 1));
  return head;
}

json place_cells(const problem& p, int node) {
  json cells = {place_name(p.geometry, node)};
  const place at = place_of_node(p.geometry, node);
  if (!std::holds_alternative<assembled>(p.geometry.kind)) cells.push_back(at.x);
  if (std::holds_alternative<plate>(p.geometry.kind)) cells.push_back(at.y);
  return cells;
}

std::vector<std::string> joined_heads(std::vector<std::string> head, const std::vector<std::string>& more) {
  head.insert(head.end(), more.begin(), more.end());
  return head;
}

json joined_cells(json row, const json& more) {
  row.insert(row.end(), more.begin(), more.end());
  return row;
}

// ---- what was given ----

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

/// "1", "1, dead load".
std::string step_words(const problem& p, int step) {
  const std::string& name = p.steps[step - 1].name;
  return name.empty() ? std::to_string(step) : fmt::format("{}, {}", step, on_one_line(name));
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

// ---- what it came to ----

/// What is read of a step's end.
struct end_reading {
  const frame& at;
  step_results read;
  std::vector<double> reactions = {};  ///< [supports]
  std::vector<double> forces = {};     ///< [pairs]
};

std::vector<end_reading> read_ends(const finished_run& r, const std::vector<int>& deflecting) {
  const load_path loads(r.what);
  std::vector<end_reading> ends;
  for (const frame& f : r.kept.frames()) {
    if (!f.step_end || ends.size() == most_table_steps) continue;
    const load now = loads.at(f.step, f.fraction);
    end_reading e{f, results_of(r.what, now, f.displacement, f.isep, deflecting)};
    for (const pair_reading& pair : e.read.pairs) e.forces.push_back(pair.force);
    e.reactions = e.read.reactions;
    ends.push_back(std::move(e));
  }
  return ends;
}

/// A value and where it is.
json placed(double value, std::string where) {
  return json::array({value, std::move(where)});
}

/// The larger of both values by magnitude, then the other one where its sign differs and it is no rounding.
json range_cell(const model& m, const value_range& v) {
  const placed_value& first = v.largest();
  json cell = json::array();
  cell.push_back(placed(first.value, place_words(m, first)));
  const placed_value& second = &first == &v.most ? v.least : v.most;
  if (second.value * first.value < -1e-9 * first.value * first.value)
    cell.push_back(placed(second.value, place_words(m, second)));
  return cell;
}

std::size_t largest_of(const std::vector<double>& values) {
  const auto most = std::ranges::max_element(values, {}, [](double v) { return std::abs(v); });
  return static_cast<std::size_t>(most - values.begin());
}

std::string quantity_head(const problem& p, std::string_view name) {
  const unit_labels& u = p.units;
  if (name == "w") return "w" + in_unit(u, 0, 1);
  if (name == "moment") return "Moment" + in_unit(u, 1, 1);
  if (name == "shear") return "Shear" + in_unit(u, 1, 0);
  const std::string unit = unit_words(p, name);
  return std::string(name) + (unit.empty() ? "" : fmt::format(" [{}]", unit.substr(1)));
}

/// The cells for forces of pairs and supports: none where no pair is pressed.
json force_cell(const problem& p, const std::vector<double>& forces) {
  const std::size_t i = largest_of(forces);
  if (forces[i] == 0.0) return nullptr;
  const std::string where = fmt::format("pair {}, {}", i + 1, place_words(p.geometry, p.pairs[i].node));
  return json::array({placed(forces[i], where)});
}
json reaction_cell(const problem& p, const std::vector<double>& reacting) {
  const std::size_t i = largest_of(reacting);
  const bool of_matrix = std::holds_alternative<assembled>(p.geometry.kind);
  const std::string dof = of_matrix ? "" : fmt::format("{} at ", dof_names(p.geometry)[p.supports[i].dof]);
  return json::array({placed(reacting[i], dof + place_words(p.geometry, p.supports[i].node))});
}

page_table end_table(const finished_run& r, const std::vector<end_reading>& ends) {
  const problem& p = r.what;
  std::vector<std::string> head = {"Step", "Share"};
  for (const value_range& v : ends.front().read.ranges) head.push_back(quantity_head(p, v.name));
  if (!p.pairs.empty()) head.push_back("Contact force" + in_unit(p.units, 1, 0));
  if (!p.supports.empty()) head.emplace_back("Reaction");
  head.emplace_back("Certificate");
  page_table t("Largest values at the end of each step", head);
  for (const end_reading& e : ends) {
    json row = {step_words(p, e.at.step), e.at.fraction};
    for (const value_range& v : e.read.ranges) row.push_back(range_cell(p.geometry, v));
    if (!p.pairs.empty()) row.push_back(force_cell(p, e.forces));
    if (!p.supports.empty()) row.push_back(reaction_cell(p, e.reactions));
    row.push_back(certificate_mark(r.judged.steps()[e.at.step - 1]));
    t.add(std::move(row));
  }
  return t;
}

/// What has a value at each step's end: pairs, or supports.
struct table_of_ends {
  std::string title;
  std::vector<std::string> head;
  std::function<json(std::size_t)> cells;  ///< in front of the values
  std::vector<double> end_reading::*values;
  bool zeros_left_out;
};

/// Which of them have rows, by number, and of how many these are the largest; those that are 0 at every end
/// are left out where the table says so.
struct chosen_rows {
  std::vector<std::size_t> rows;
  std::size_t all, zeros;
};
chosen_rows choose_rows(const std::vector<end_reading>& ends, const table_of_ends& of) {
  std::vector<double> largest((ends.front().*of.values).size());
  for (const end_reading& e : ends)
    for (std::size_t i = 0; i < largest.size(); ++i)
      largest[i] = std::max(largest[i], std::abs((e.*of.values)[i]));
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < largest.size(); ++i)
    if (largest[i] > 0.0 || !of.zeros_left_out) rows.push_back(i);
  const std::size_t all = rows.size();
  if (all > most_rows) {
    std::ranges::stable_sort(rows, std::greater{}, [&](std::size_t i) { return largest[i]; });
    rows.resize(most_rows);
    std::ranges::sort(rows);
  }
  return {std::move(rows), all, largest.size() - all};
}

/// The steps are columns, a few in each table.
void put_ends(const problem& p, const std::vector<end_reading>& ends, const table_of_ends& of, json& tables,
              std::vector<std::string>& omissions) {
  const auto [rows, all, zeros] = choose_rows(ends, of);
  const std::string title =
      zeros == 0 ? of.title
                 : fmt::format("{}; {} that are 0 at all of these ends have no row", of.title, zeros);
  if (zeros > 0 && all <= most_rows) omissions.push_back(title + ".");
  for (std::size_t from = 0; from < ends.size(); from += steps_beside) {
    const auto some = std::span(ends).subspan(from, std::min(steps_beside, ends.size() - from));
    std::vector<std::string> head = of.head;
    for (const end_reading& e : some) head.push_back("Step " + step_words(p, e.at.step));
    page_table t(title, head);
    json chosen = json::array();
    for (const std::size_t i : rows) {
      json& row = chosen.emplace_back(of.cells(i));
      for (const end_reading& e : some) row.push_back((e.*of.values)[i]);
    }
    t.choose(std::move(chosen), all, "largest");
    std::vector<std::string> said;
    t.put_into(tables, from == 0 ? omissions : said);
  }
}

/// What a support holds, with the unit of its reaction.
std::string support_words(const problem& p, const support& s) {
  const bool of_matrix = std::holds_alternative<assembled>(p.geometry.kind);
  return of_matrix ? "" : dof_names(p.geometry)[s.dof] + force_unit(p, s.dof);
}

std::string time_words(const envelope::when& reached) {
  return fmt::format("step {}, increment {}", reached.step, reached.increment);
}

json timed_cell(double value, const envelope::when& reached) {
  return json::array({placed(value, time_words(reached))});
}

json bound_cell(const model& m, const envelope::bound& b) {
  return json::array({placed(b.at.value, place_words(m, b.at) + "; " + time_words(b.reached))});
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

json envelope_tables(const finished_run& r, std::vector<std::string>& omissions) {
  const problem& p = r.what;
  envelope of_kept(p);
  if (r.all_increments == nullptr) {
    for (const frame& f : r.kept.frames()) of_kept.take(f);
    if (std::ssize(r.kept.frames()) < r.kept.increments() + 1)
      omissions.push_back(fmt::format(
          "The envelope is that of the {} states on this page; --envelope makes it of all increments.",
          r.kept.frames().size() - 1));
  }
  const envelope& all = r.all_increments != nullptr ? *r.all_increments : of_kept;
  json tables = json::array();
  page_table quantities("Least and largest of all increments", {"Quantity", "Least", "Largest"});
  for (const envelope::range& v : all.ranges())
    quantities.add(
        {quantity_head(p, v.name), bound_cell(p.geometry, v.least), bound_cell(p.geometry, v.most)});
  quantities.put_into(tables, omissions);
  page_table forces("Largest contact force of each pair" + in_unit(p.units, 1, 0),
                    joined_heads(joined_heads({"Pair"}, place_head(p)), {"Face", "Largest"}));
  for (std::size_t i = 0; i < all.pairs().size(); ++i) {
    const contact_pair& at = p.pairs[i];
    forces.add(
        joined_cells(joined_cells({std::to_string(i + 1)}, place_cells(p, at.node)),
                     {surface_name(at.surface), timed_cell(all.pairs()[i].force, all.pairs()[i].reached)}));
  }
  forces.put_into(tables, omissions);
  page_table reacting("Reactions: what supports exert on the structure",
                      joined_heads(place_head(p), {"What", "Least", "Largest"}));
  for (std::size_t i = 0; i < all.reactions().size(); ++i) {
    const envelope::reaction_range& v = all.reactions()[i];
    reacting.add(joined_cells(place_cells(p, p.supports[i].node),
                              {support_words(p, p.supports[i]), timed_cell(v.least, v.least_reached),
                               timed_cell(v.most, v.most_reached)}));
  }
  reacting.put_into(tables, omissions);
  return tables;
}

json result_tables(const finished_run& r, const std::vector<int>& deflecting,
                   std::vector<std::string>& omissions) {
  json tables = json::array();
  const problem& p = r.what;
  const std::vector<end_reading> ends = read_ends(r, deflecting);
  if (ends.empty()) return tables;
  const std::size_t all = r.judged.steps().size();
  if (ends.size() < all)
    omissions.push_back(fmt::format("Tables have the ends of {} of {} steps.", ends.size(), all));
  end_table(r, ends).put_into(tables, omissions);
  const auto cells_of_pair = [&p](std::size_t i) {
    return joined_cells(joined_cells({std::to_string(i + 1)}, place_cells(p, p.pairs[i].node)),
                        {surface_name(p.pairs[i].surface)});
  };
  if (!p.pairs.empty())
    put_ends(p, ends,
             {"Contact forces" + in_unit(p.units, 1, 0),
              joined_heads(joined_heads({"Pair"}, place_head(p)), {"Face"}), cells_of_pair,
              &end_reading::forces, true},
             tables, omissions);
  const auto cells_of_support = [&p](std::size_t i) {
    const support& s = p.supports[i];
    return joined_cells(place_cells(p, s.node), json::array({support_words(p, s)}));
  };
  if (!p.supports.empty())
    put_ends(p, ends,
             {"Reactions: what supports exert on the structure", joined_heads(place_head(p), {"What"}),
              cells_of_support, &end_reading::reactions, false},
             tables, omissions);
  return tables;
}

}  // namespace contct::write
