#include "contct/write/result_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "contct/matrix/cholesky.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

/// Numbers from 1.
json numbered(const std::vector<int>& all) {
  return list_of(all, [](int i) { return i + 1; });
}

/// "all", "2..9", or a list; from 1.
json elements_json(const std::vector<int>& elements) {
  if (elements.empty()) return "all";
  if (!is_run(elements)) return numbered(elements);
  return fmt::format("{}..{}", elements.front() + 1, elements.back() + 1);
}

json event_json(const problem& p, const event& e) {
  const contact_pair& at = p.pairs[e.pair];
  json entry = {{"pair", e.pair + 1}};
  put_place(entry, p.geometry, at.node);
  entry.update({{"surface", surface_name(at.surface)}, {"change", change_name(e.what)}});
  return entry;
}

json reaction_json(const model& m, const support& at) {
  json entry;
  put_place(entry, m, at.node);
  if (!entry.contains("dof")) entry["dof"] = dof_names(m)[at.dof];
  return entry;
}

json value_json(const model& m, const placed_value& at) {
  json entry = {{"value", at.value}};
  if (std::holds_alternative<assembled>(m.kind)) {
    put_place(entry, m, at.node);
    entry["x"] = nullptr;  // as far as the structure itself goes
    return entry;
  }
  entry["x"] = at.x;
  if (std::holds_alternative<plate>(m.kind)) entry["y"] = at.y;
  return entry;
}

json extremes_json(const model& m, const std::vector<value_range>& ranges) {
  json out = json::object();
  for (const value_range& r : ranges)
    out[std::string(r.name)] = {{"min", value_json(m, r.least)}, {"max", value_json(m, r.most)}};
  return out;
}

void put_time(json& entry, const envelope::when& reached) {
  entry.update({{"step", reached.step}, {"increment", reached.increment}});
}

json envelope_json(const problem& p, const envelope& e) {
  const model& m = p.geometry;
  const auto bound = [&m](const envelope::bound& b) {
    json entry = value_json(m, b.at);
    put_time(entry, b.reached);
    return entry;
  };
  const auto reached = [](double value, const envelope::when& at) {
    json entry = {{"value", value}};
    put_time(entry, at);
    return entry;
  };
  json out = {{"states", e.states()}};
  for (const envelope::range& r : e.ranges())
    out[std::string(r.name)] = {{"min", bound(r.least)}, {"max", bound(r.most)}};
  out["pairs"] = list_of(e.pairs(), [i = 0](const envelope::peak& peak) mutable {
    json entry = {{"pair", ++i}, {"force_max", peak.force}};
    put_time(entry, peak.reached);
    return entry;
  });
  out["reactions"] = list_of(e.reactions(), [&, i = 0](const envelope::reaction_range& r) mutable {
    json entry = reaction_json(m, p.supports[i++]);
    entry.update({{"min", reached(r.least, r.least_reached)}, {"max", reached(r.most, r.most_reached)}});
    return entry;
  });
  return out;
}

json element_json(const element_results& results, std::size_t e) {
  json entry = {{"element", e + 1}};
  for (std::size_t i = 0; i < results.names.size(); ++i)
    entry[std::string(results.names[i])] = results.at(e, i);
  return entry;
}

json units_json(const unit_labels& units) {
  if (units.length.empty()) return nullptr;
  return {{"length", units.length}, {"force", units.force}};
}

json lockstep_json(const lockstep& compared) {
  json out = agreement_json(compared.calls(), compared.compared());
  if (!compared.first()) return out;
  const mismatch_report& d = *compared.first();
  out["first"] = {{"call", d.call},         {"kernel", d.follower},     {"field", d.where.field},
                  {"index", d.where.index}, {"leader", d.where.leader}, {"follower", d.where.follower},
                  {"ulps", d.where.ulps}};
  return out;
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

json certificate_json(const std::optional<certificate>& c) {
  if (!c) return nullptr;
  json out = {{"exact", c->certified},         {"displacement_error", c->displacement_error},
              {"equilibrium", c->equilibrium}, {"penetration", c->penetration},
              {"tension", c->tension},         {"rcond", c->rcond},
              {"tolerance", certified_share},  {"shape_error", c->shape_error},
              {"unique", c->unique},           {"independent", c->independent},
              {"digits", digits_of(*c)}};
  if (!c->unique) out["displacement_error"] = out["shape_error"] = nullptr;
  if (!c->problem.empty()) out["problem"] = c->problem;
  return out;
}

json error_json(const problem& p, const std::optional<certificate>& c) {
  const bool of_beam = std::holds_alternative<beam>(p.geometry.kind);
  const bool of_matrix = std::holds_alternative<assembled>(p.geometry.kind);
  json out = json::object();
  const auto put = [&](quantity q, bool is_there) {
    const std::optional<double> bound = c && c->proved ? c->error[q] : std::nullopt;
    if (is_there) out[quantity_names[static_cast<std::size_t>(q)]] = bound ? json(*bound) : json(nullptr);
  };
  put(quantity::w, true);
  put(quantity::slope, !of_matrix);
  put(quantity::force, !p.pairs.empty());
  put(quantity::gap, !p.pairs.empty());
  put(quantity::reaction, !p.supports.empty());
  put(quantity::moment, !of_matrix);
  put(quantity::shear, of_beam);
  return out;
}

json agreement_json(std::int64_t calls, const tally& compared) {
  return {{"calls", calls}, {"values_compared", compared.values}, {"mismatches", compared.mismatches}};
}

json load_json(const model& m, const load_path& loads, int step, double fraction) {
  const resultant r = loads.resultant_at(step, fraction);
  const auto names = dof_names(m);
  json out = {{std::holds_alternative<assembled>(m.kind) ? "sum" : "force", r.force}};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    out[r.moments.size() == 1 ? "moment" : fmt::format("moment_{}", names[i + 1])] = r.moments[i];
  if (loads.has_many_parts(step)) return out;
  const load l = loads.at(step, fraction);
  for (const distributed_load& d : l.distributed) {
    const bool constant = d.polynomial.size() == 1;
    out["uniform"].push_back(
        {{constant ? "value" : "polynomial", constant ? json(d.polynomial[0]) : json(d.polynomial)},
         {"elements", elements_json(d.elements)}});
  }
  for (const point_load& p : l.points) {
    json& point = out["point"].emplace_back();
    put_place(point, m, p.node);
    point[names[p.dof]] = p.value;
  }
  for (const prescribed_displacement& g : l.settlements) {
    json& settled = out["settlement"].emplace_back();
    put_place(settled, m, g.node);
    settled[names[g.dof]] = g.value;
  }
  return out;
}

void put_place(json& entry, const model& m, int node) {
  if (const auto* a = std::get_if<assembled>(&m.kind)) {
    entry["dof"] = a->label_of(node);
  } else {
    entry["node"] = node + 1;
  }
}

result_json::result_json(const problem& p, const std::vector<std::string>& kernels, std::string_view engine,
                         const certifier& judged, output_file& out)
    : problem_(p),
      judged_(judged),
      loads_(p),
      document_(out,
                {{"format", "contct-result-1"},
                 {"title", p.title},
                 {"units", units_json(p.units)},
                 {"kernels", kernels},
                 {"engine", engine}},
                "steps") {}

void result_json::step_ended(const step_state& s) {
  const model& m = problem_.geometry;
  const step_results r = results_of(problem_, loads_.at(s.step, s.fraction), s, deflecting_);
  std::vector<double> w(nodes(m));
  for (int node = 0; node < nodes(m); ++node) w[node] = deflection_of(problem_, s.displacement, node);
  json members = {{"step", s.step},
                  {"name", problem_.steps[s.step - 1].name},
                  {"fraction", s.fraction},
                  {"increments", nullptr},
                  {"w", w}};
  members["displacement"] = s.displacement;
  members.update({{"pairs", nullptr},
                  {"reactions", nullptr},
                  {"elements", nullptr},
                  {"extremes", extremes_json(m, r.ranges)},
                  {"extremes_at", ranges_are_at(m)}});
  if (s.from_fallback) members["ended_by"] = "oracle";
  if (s.from_exact_path) members["ended_by"] = "exact";
  const std::optional<certificate>& judged = judged_.steps().back();
  members.update({{"rcond", s.rcond},
                  {"digits", judged ? json(digits_of(*judged)) : json(nullptr)},
                  {"error", error_json(problem_, judged)},
                  {"certificate", certificate_json(judged)}});
  document_.add(members,
                {{"increments", increments_.size(), [this](auto i) { return increment_of(i); }},
                 {"pairs", problem_.pairs.size(), [&](auto i) { return pair_in(s, i, r.pairs[i]); }},
                 {"reactions", r.reactions.size(),
                  [&](auto i) {
                    json entry = reaction_json(m, problem_.supports[i]);
                    entry["value"] = r.reactions[i];
                    return entry;
                  }},
                 {"elements", r.elements.elements(), [&](auto i) { return element_json(r.elements, i); }}});
  increments_.clear();
}

json result_json::increment_of(std::size_t at) const {
  const increment_record& i = increments_[at];
  json entry = {{"increment", i.number},
                {"s", i.s},
                {"fraction", i.fraction},
                {"load", load_json(problem_.geometry, loads_, i.step, i.fraction)},
                {"events", list_of(i.events, [this](const event& e) { return event_json(problem_, e); })}};
  if (i.snaps) entry["snap"] = true;
  return entry;
}

json result_json::pair_in(const step_state& s, std::size_t pair, const pair_reading& r) const {
  const contact_pair& p = problem_.pairs[pair];
  json entry = {{"pair", pair + 1}};
  put_place(entry, problem_.geometry, p.node);
  entry.update({{"surface", surface_name(p.surface)},
                {"state", state_name(s.isep[pair])},
                {"gap", r.gap},
                {"force", r.force}});
  return entry;
}

void result_json::finish(std::string_view status, const path_end& end, const lockstep* compared,
                         const envelope* all) {
  json members = {{"end",
                   {{"reason", end_reason(end.status)},
                    {"step", end.step},
                    {"fraction", end.fraction},
                    {"pairs", numbered(end.pairs)}}},
                  {"engine_work",
                   {{"factors", end.work.factors},
                    {"solves", end.work.solves},
                    {"updates", end.work.updates},
                    {"checks", end.work.checks}}}};
  if (!free_runs_.empty()) members["free_run"] = nullptr;
  members["lockstep"] = compared == nullptr ? json(nullptr) : lockstep_json(*compared);
  members["status"] = status;
  if (all != nullptr) members["envelope"] = envelope_json(problem_, *all);
  members["certified"] = end.status == path_status::solved && judged_.all_certified();
  document_.finish(members, {{"free_run", free_runs_.size(), [this](auto i) -> json {
                                const auto& [kernel, d, certified] = free_runs_[i];
                                return {{"kernel", kernel},
                                        {"same_end", d.same_end},
                                        {"same_events", d.same_events},
                                        {"first_difference", d.first_difference},
                                        {"fraction", d.fraction},
                                        {"displacement", d.displacement},
                                        {"bound", d.bound},
                                        {"within_bound", d.within_bound()},
                                        {"certified", certified}};
                              }}});
}

}  // namespace contct::write
