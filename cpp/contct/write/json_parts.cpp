#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "contct/results/quantities.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

/// Returns "all", "2..9", or a list of numbers from 1.
json elements_json(const std::vector<int>& elements) {
  if (elements.empty()) return "all";
  if (!is_run(elements)) return numbered(elements);
  return fmt::format("{}..{}", elements.front() + 1, elements.back() + 1);
}

/// Adds a node, from 0, to `entry`: "node": 3, or "dof": "185.3" and "other" in a matrix.
void put_place(json& entry, const model& m, int node, int other = -1) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) {
    entry["dof"] = a->label_of(node);
    if (other >= 0) entry["other"] = a->label_of(other);
  } else {
    entry["node"] = node + 1;
  }
}

}  // namespace

json_document::json_document(output_file& out, const json& members, std::string_view name) : out_(out) {
  out_.write("{");
  write_members(members, {}, 2);
  out_.write(fmt::format(",\n  {}: [", json_text(json(name))));
}

void json_document::write_members(const json& members, const std::vector<list>& lists, int indent) {
  std::string_view before;
  for (const auto& [name, value] : members.items()) {
    out_.write(fmt::format("{}\n{:{}}{}: ", std::exchange(before, ","), "", indent, json_text(json(name))));
    const auto l = std::ranges::find(lists, std::string_view(name), &list::name);
    if (l == lists.end()) {
      out_.write(json_text(value));
    } else {
      out_.write("[");
      for (std::size_t i = 0; i < l->count; ++i)
        out_.write(fmt::format("{}\n{:{}}{}", i == 0 ? "" : ",", "", indent + 2, json_text(l->entry(i))));
      out_.write(l->count == 0 ? "]" : fmt::format("\n{:{}}]", "", indent));
    }
  }
}

void json_document::add(const json& members, const std::vector<list>& lists) {
  out_.write(fmt::format("{}\n    {{", std::exchange(before_, ",")));
  write_members(members, lists, 6);
  out_.write("\n    }");
}

void json_document::finish(const json& members, const std::vector<list>& lists) {
  out_.write(before_.empty() ? "]," : "\n  ],");
  write_members(members, lists, 2);
  out_.write("\n}\n");
  out_.finish();
}

json numbered(const std::vector<int>& from_0) {
  return list_of(from_0, [](int i) { return i + 1; });
}

json units_json(const unit_labels& units) {
  if (units.length.empty()) return nullptr;
  return {{"length", units.length}, {"force", units.force}};
}

json certificate_json(const solved_step& s) {
  const std::optional<certificate>& c = s.judged;
  if (!c) return nullptr;
  const auto proved = [&](double x, bool known = true) {
    return c->proved && known ? json(x) : json(nullptr);
  };
  json out = {{"certified", c->certified},
              {"displacement_error", proved(c->displacement_error, c->unique)},
              {"equilibrium", proved(c->equilibrium)},
              {"penetration", proved(c->penetration)},
              {"tension", proved(c->tension)},
              {"rcond", s.rcond},
              {"tolerance", certified_share},
              {"shape_error", proved(c->worst_share, c->unique)},
              {"unique", c->unique},
              {"independent", s.from != origin::reference},
              {"digits", digits_of(*c)}};
  if (!c->problem.empty()) out["problem"] = c->problem;
  return out;
}

json error_json(const problem& p, const std::optional<certificate>& c) {
  json out = json::object();
  for (std::size_t i = 0; i < quantity_names.size(); ++i) {
    const auto kind = static_cast<quantity>(i);
    if (!has_kind(p, kind)) continue;
    json& bound = out[quantity_names[i].key];  // null
    if (c && c->proved && c->error[kind]) bound = *c->error[kind];
  }
  return out;
}

json value_json(const model& m, const placed_value& at) {
  json entry = {{"value", at.value}};
  if (!at.name.empty()) entry["name"] = at.name;
  if (std::holds_alternative<assembled>(m.kind)) {
    put_place(entry, m, at.node);
    entry["x"] = nullptr;  // a matrix has no x
    return entry;
  }
  entry["x"] = at.x;
  if (std::holds_alternative<plate>(m.kind)) entry["y"] = at.y;
  return entry;
}

json range_json(const model& m, const value_range& r) {
  return {{"min", value_json(m, r.least)}, {"max", value_json(m, r.most)}};
}

json& watched_entry(json& out, const problem& p, std::size_t part, const quantity_row& row) {
  if (out.is_null())
    out = list_of(p.watches, [](const watched_part& watched) -> json {
      return {{"name", watched.name}, {"extremes", json::object()}};
    });
  return out[part]["extremes"][std::string(row.key)];
}

json mesh_error_json(const mesh_error& e) {
  if (!e.not_proved.empty()) return {{"kind", "unknown"}, {"because", e.not_proved}};
  json out = {{"kind", "proved"}};
  for (const mesh_number& n : e.numbers) {
    out["error"][std::string(n.key)] = n.error;
    out["of"][std::string(n.key)] = n.of;
  }
  out["extremes"] = json::object();
  for (const true_extremes& x : e.extremes)
    out["extremes"][std::string(x.key)] = {{"min", x.least}, {"max", x.most}};
  return out;
}

json agreement_json(std::int64_t calls, const tally& compared) {
  return {{"calls", calls}, {"values_compared", compared.values}, {"mismatches", compared.mismatches}};
}

namespace {

void put_values(json& entry, const std::vector<double>& polynomial) {
  const bool constant = polynomial.size() == 1;
  entry[constant ? "value" : "polynomial"] = constant ? json(polynomial[0]) : json(polynomial);
}

/// Adds a load between nodes to the lists of loads in `out`, in the form of the problem file.
void put_placed(json& out, const model& m, const placed_load& p) {
  const std::vector<double> values = values_of(p);
  if (p.is_at_point()) {
    out["point"].push_back({{"x", p.from.x}, {dof_names(m)[p.what == load_kind::point ? 0 : 1], values[0]}});
    return;
  }
  const bool turns = p.what == load_kind::moment;
  json& entry = out[turns ? "moments" : p.what == load_kind::force ? "uniform" : "curvature"].emplace_back();
  if (turns)
    entry = {{"wx", values[0]}, {"wy", values[1]}};
  else
    put_values(entry, values);
  const bool of_plate = std::holds_alternative<plate>(m.kind);
  entry["from"] = of_plate ? json({p.from.x, p.across[0].x}) : json(p.from.x);
  entry["to"] = of_plate ? json({p.to.x, p.across[1].x}) : json(p.to.x);
}

}  // namespace

json load_json(const model& m, const resultant& r, const load* parts) {
  const auto names = dof_names(m);
  json out = {{std::holds_alternative<assembled>(m.kind) ? "sum" : "force", r.force}};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    out[fmt::format("moment{}", r.moments.size() == 1 ? "" : fmt::format("_{}", names[i + 1]))] =
        r.moments[i];
  if (parts == nullptr) return out;
  for (const distributed_load& d : parts->distributed) {
    json& entry = out["uniform"].emplace_back();
    put_values(entry, d.polynomial);
    entry["elements"] = elements_json(d.elements);
    if (d.is_self_weight) entry["self_weight"] = true;
  }
  for (const placed_load& p : parts->placed) put_placed(out, m, p);
  const auto put_all = [&](const char* key, const auto& all) {
    for (const auto& at : all) {
      json& entry = out[key].emplace_back();
      put_place(entry, m, at.node);
      entry[names[at.dof]] = product_of<double>(at.value, at.factor);
    }
  };
  put_all("point", parts->points);
  put_all("settlement", parts->settlements);
  put_all("move", parts->moves);
  return out;
}

json load_json(const problem& p, const load_path& loads, int step, double fraction, bool whole) {
  const resultant r = loads.resultant_at(step, fraction);
  if (!whole && loads.has_many_parts(step)) return load_json(p.geometry, r, nullptr);
  const load l = load_at(p, step, fraction);
  return load_json(p.geometry, r, &l);
}

void put_name(json& entry, const problem& p, on list, std::size_t i) {
  if (const std::string_view name = name_of_entry(p, list, i); !name.empty()) entry["name"] = name;
}

json pair_json(const problem& p, std::size_t i) {
  json entry = {{"pair", i + 1}};
  put_place(entry, p.geometry, p.pairs[i].node, p.pairs[i].other);
  entry["surface"] = surface_name(p.pairs[i].surface);
  put_name(entry, p, on::pairs, i);
  return entry;
}

json event_json(const problem& p, const event& e) {
  json entry = pair_json(p, e.pair);
  entry["change"] = change_name(e.what);
  return entry;
}

json pair_state_json(const problem& p, std::size_t i, int isep, const json& gap, const json& force) {
  json entry = pair_json(p, i);
  entry.update({{"state", state_name(isep)}, {"gap", gap}, {"force", force}});
  return entry;
}

json reaction_json(const problem& p, std::size_t i, const json& value) {
  json entry = support_json(p, i);
  entry["value"] = value;
  return entry;
}

json support_json(const problem& p, std::size_t i) {
  json entry;
  put_place(entry, p.geometry, p.supports[i].node);
  if (!entry.contains("dof")) entry["dof"] = dof_names(p.geometry)[p.supports[i].dof];
  put_name(entry, p, on::supports, i);
  return entry;
}

namespace {

/// An entry of a list, with its place or number, and with its name.
json begun_entry(const problem& p, on where, std::size_t i) {
  if (where == on::supports) return support_json(p, i);
  json entry = {{list_of(where).entry, i + 1}};
  if (where != on::pairs || i < contacts_of(p)) put_name(entry, p, where, i);
  return entry;
}

}  // namespace

json envelope_json(const problem& p, const envelope& e) {
  const auto reached = [&p](const envelope::reached& at, bool placed) {
    json entry = placed ? value_json(p.geometry, at) : json{{"value", at.value}};
    entry.update({{"step", at.step}, {"increment", at.increment}});
    return entry;
  };
  const auto range = [&reached](const envelope::range& r, bool placed) -> json {
    return {{"min", reached(r.least, placed)}, {"max", reached(r.most, placed)}};
  };
  json out = {{"states", e.states}};
  for (const auto& [row, at, part] : e.values) out[std::string(row->key)] = range(at[0], true);
  std::map<on, json> lists = {{on::pairs, json::array()}, {on::supports, json::array()}};
  for (const auto& [row, at, part] : e.lists) {
    json& list = lists[row->where];
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (i == list.size()) list.push_back(begun_entry(p, row->where, i));
      json& entry = list[i];
      const envelope::reached& most = at[i].most;
      if (row->kind == quantity::force)
        entry.update({{"force_max", most.value}, {"step", most.step}, {"increment", most.increment}});
      if (most.step == 0 || (row->where == on::pairs && i >= contacts_of(p))) continue;
      if (row->where == on::supports)
        entry.update(range(at[i], false));
      else
        entry[key_in_list(*row)] = range(at[i], false);
    }
  }
  out.update({{"pairs", lists[on::pairs]}, {"reactions", lists[on::supports]}});
  for (const on where : {on::beds, on::hinges})
    if (lists.contains(where)) out[list_of(where).name] = lists[where];
  for (const auto& [row, at, part] : e.watched)
    watched_entry(out["watch"], p, part, *row) = range(at[0], true);
  if (e.x.empty()) return out;
  json& curves = out["curves"] = {{"x", e.x}};
  for (const auto& [row, at, part] : e.curves) {
    json& entry = curves[std::string(row->key)];
    entry["min"] = list_of(at, [](const auto& r) { return r.least.value; });
    entry["max"] = list_of(at, [](const auto& r) { return r.most.value; });
    entry["min_step"] = list_of(at, [](const auto& r) { return r.least.step; });
    entry["max_step"] = list_of(at, [](const auto& r) { return r.most.step; });
  }
  return out;
}

}  // namespace contct
