#include "contct/write/run_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "contct/write/page_table.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

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
    end_reading e{f, results_of(r.what, now, f, deflecting)};
    for (const pair_reading& pair : e.read.pairs) e.forces.push_back(pair.force);
    e.reactions = e.read.reactions;
    ends.push_back(std::move(e));
  }
  return ends;
}

/// The largest of each kind of number on these tables; beside it, smaller ones may be rounding.
class sizes {
 public:
  void take(std::string_view kind, double value) {
    double& size = largest_[std::string(kind)];
    size = std::max(size, std::abs(value));
  }
  /// A value and where it is.
  [[nodiscard]] json placed(std::string_view kind, double value, const std::string& where) const {
    json cell = {value, where};
    if (none(kind, value)) cell.push_back(true);
    return cell;
  }
  /// A value whose place its row says.
  [[nodiscard]] json cell(std::string_view kind, double value) const {
    if (none(kind, value)) return json::array({placed(kind, value, "")});
    return value;
  }

 private:
  [[nodiscard]] bool none(std::string_view kind, double value) const {
    return value != 0.0 && is_rounding(value, largest_.at(std::string(kind)));
  }

  std::map<std::string, double> largest_;
};

/// A plate's moments are of one kind.
std::string_view kind_of(std::string_view range_name) {
  return range_name.starts_with("m") ? "moment" : range_name;
}
std::string_view kind_of(const support& s) {
  return s.dof == 0 ? "force" : "reaction moment";
}

sizes sizes_of(const problem& p, const std::vector<end_reading>& ends) {
  sizes all;
  for (const end_reading& e : ends) {
    for (const value_range& v : e.read.ranges) all.take(kind_of(v.name), v.largest().value);
    for (const double f : e.forces) all.take("force", f);
    for (std::size_t i = 0; i < e.reactions.size(); ++i) all.take(kind_of(p.supports[i]), e.reactions[i]);
  }
  return all;
}

sizes sizes_of(const problem& p, const envelope& most) {
  sizes all;
  for (const envelope::range& v : most.ranges()) {
    all.take(kind_of(v.name), v.least.at.value);
    all.take(kind_of(v.name), v.most.at.value);
  }
  for (const auto& pair : most.pairs()) all.take("force", pair.force);
  for (std::size_t i = 0; i < most.reactions().size(); ++i) {
    all.take(kind_of(p.supports[i]), most.reactions()[i].least);
    all.take(kind_of(p.supports[i]), most.reactions()[i].most);
  }
  return all;
}

/// The larger of both values by magnitude, then the other one where its sign differs and it is no rounding.
json range_cell(const model& m, const sizes& all, const value_range& v) {
  const placed_value& first = v.largest();
  json cell = json::array();
  cell.push_back(all.placed(kind_of(v.name), first.value, place_words(m, first)));
  const placed_value& second = &first == &v.most ? v.least : v.most;
  if (second.value * first.value < -1e-9 * first.value * first.value)
    cell.push_back(all.placed(kind_of(v.name), second.value, place_words(m, second)));
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
json force_cell(const problem& p, const sizes& all, const std::vector<double>& forces) {
  const std::size_t i = largest_of(forces);
  if (forces[i] == 0.0) return nullptr;
  const std::string where = fmt::format("pair {}, {}", i + 1, place_words(p.geometry, p.pairs[i].node));
  return json::array({all.placed("force", forces[i], where)});
}
json reaction_cell(const problem& p, const sizes& all, const std::vector<double>& reacting) {
  const std::size_t i = largest_of(reacting);
  const bool of_matrix = std::holds_alternative<assembled>(p.geometry.kind);
  const std::string dof = of_matrix ? "" : fmt::format("{} at ", dof_names(p.geometry)[p.supports[i].dof]);
  const std::string where = dof + place_words(p.geometry, p.supports[i].node);
  return json::array({all.placed(kind_of(p.supports[i]), reacting[i], where)});
}

page_table end_table(const finished_run& r, const sizes& all, const std::vector<end_reading>& ends) {
  const problem& p = r.what;
  std::vector<std::string> head = {"Step", "Share"};
  for (const value_range& v : ends.front().read.ranges) head.push_back(quantity_head(p, v.name));
  if (!p.pairs.empty()) head.push_back("Contact force" + in_unit(p.units, 1, 0));
  if (!p.supports.empty()) head.emplace_back("Reaction");
  head.emplace_back("Certificate");
  page_table t("Largest values at the end of each step", head);
  for (const end_reading& e : ends) {
    json row = {step_words(p, e.at.step), e.at.fraction};
    for (const value_range& v : e.read.ranges) row.push_back(range_cell(p.geometry, all, v));
    if (!p.pairs.empty()) row.push_back(force_cell(p, all, e.forces));
    if (!p.supports.empty()) row.push_back(reaction_cell(p, all, e.reactions));
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
  std::function<std::string_view(std::size_t)> kind;
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
void put_ends(const problem& p, const sizes& sized, const std::vector<end_reading>& ends,
              const table_of_ends& of, json& tables, std::vector<std::string>& omissions) {
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
      for (const end_reading& e : some) row.push_back(sized.cell(of.kind(i), (e.*of.values)[i]));
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

json timed_cell(const sizes& all, std::string_view kind, double value, const envelope::when& reached) {
  return json::array({all.placed(kind, value, time_words(reached))});
}

json bound_cell(const model& m, const sizes& all, std::string_view kind, const envelope::bound& b) {
  return json::array({all.placed(kind, b.at.value, place_words(m, b.at) + "; " + time_words(b.reached))});
}

}  // namespace

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
  const sizes sized = sizes_of(p, all);
  json tables = json::array();
  page_table quantities("Least and largest of all increments", {"Quantity", "Least", "Largest"});
  for (const envelope::range& v : all.ranges())
    quantities.add({quantity_head(p, v.name), bound_cell(p.geometry, sized, kind_of(v.name), v.least),
                    bound_cell(p.geometry, sized, kind_of(v.name), v.most)});
  quantities.put_into(tables, omissions);
  page_table forces("Largest contact force of each pair" + in_unit(p.units, 1, 0),
                    joined_heads(joined_heads({"Pair"}, place_head(p)), {"Surface", "Largest"}));
  for (std::size_t i = 0; i < all.pairs().size(); ++i) {
    const contact_pair& at = p.pairs[i];
    forces.add(joined_cells(joined_cells({std::to_string(i + 1)}, place_cells(p, at.node)),
                            {surface_name(at.surface),
                             timed_cell(sized, "force", all.pairs()[i].force, all.pairs()[i].reached)}));
  }
  forces.put_into(tables, omissions);
  page_table reacting("Reactions: what supports exert on the structure",
                      joined_heads(place_head(p), {"What", "Least", "Largest"}));
  for (std::size_t i = 0; i < all.reactions().size(); ++i) {
    const envelope::reaction_range& v = all.reactions()[i];
    const std::string_view kind = kind_of(p.supports[i]);
    reacting.add(
        joined_cells(place_cells(p, p.supports[i].node),
                     {support_words(p, p.supports[i]), timed_cell(sized, kind, v.least, v.least_reached),
                      timed_cell(sized, kind, v.most, v.most_reached)}));
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
  const sizes sized = sizes_of(p, ends);
  end_table(r, sized, ends).put_into(tables, omissions);
  const auto cells_of_pair = [&p](std::size_t i) {
    return joined_cells(joined_cells({std::to_string(i + 1)}, place_cells(p, p.pairs[i].node)),
                        {surface_name(p.pairs[i].surface)});
  };
  if (!p.pairs.empty())
    put_ends(p, sized, ends,
             {"Contact forces" + in_unit(p.units, 1, 0),
              joined_heads(joined_heads({"Pair"}, place_head(p)), {"Surface"}), cells_of_pair,
              [](std::size_t) { return std::string_view("force"); }, &end_reading::forces, true},
             tables, omissions);
  const auto cells_of_support = [&p](std::size_t i) {
    const support& s = p.supports[i];
    return joined_cells(place_cells(p, s.node), json::array({support_words(p, s)}));
  };
  if (!p.supports.empty())
    put_ends(p, sized, ends,
             {"Reactions: what supports exert on the structure", joined_heads(place_head(p), {"What"}),
              cells_of_support, [&p](std::size_t i) { return kind_of(p.supports[i]); },
              &end_reading::reactions, false},
             tables, omissions);
  return tables;
}

}  // namespace contct::write
