#include "contct/write/result_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "contct/matrix/cholesky.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

/// Numbers from 1.
json numbered(const std::vector<int>& all) {
  json list = json::array();
  for (const int i : all) list.push_back(i + 1);
  return list;
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

json_document::json_document(output_file& out) : out_(out) {
  open('{');
}

void json_document::open(char bracket) {
  out_.write({&bracket, 1});
  closing_ += bracket == '{' ? '}' : ']';
  empty_ = true;
}

void json_document::begin_line(std::string_view name) {
  out_.write(fmt::format("{}\n{:{}}", empty_ ? "" : ",", "", 2 * closing_.size()));
  if (!name.empty()) out_.write(json(name).dump() + ": ");
  empty_ = false;
}

void json_document::put(std::string_view name, const json& value) {
  begin_line(name);
  out_.write(value.dump());
}

void json_document::put(const json& members) {
  for (const auto& [name, value] : members.items()) put(name, value);
}

void json_document::add(const json& value) {
  begin_line();
  out_.write(value.dump());
}

void json_document::open_array(std::string_view name) {
  begin_line(name);
  open('[');
}

void json_document::open_object() {
  begin_line();
  open('{');
}

void json_document::close() {
  const char bracket = closing_.back();
  closing_.pop_back();
  if (!empty_) out_.write(fmt::format("\n{:{}}", "", 2 * closing_.size()));
  out_.write({&bracket, 1});
  empty_ = false;
}

void json_document::finish() {
  while (!closing_.empty()) close();
  out_.write("\n");
  out_.finish();
}

json certificate_json(const std::optional<certificate>& c) {
  if (!c) return nullptr;
  json out = {{"exact", c->exact},
              {"displacement_error", c->displacement_error},
              {"equilibrium", c->equilibrium},
              {"penetration", c->penetration},
              {"tension", c->tension},
              {"rcond", c->rcond},
              {"tolerance", c->tolerance},
              {"shape_error", c->shape_error},
              {"unique", c->unique},
              {"independent", c->independent},
              {"digits", digits_left(c->rcond)}};
  if (!c->unique) out["displacement_error"] = out["shape_error"] = nullptr;
  if (!c->problem.empty()) out["problem"] = c->problem;
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
    : problem_(p), judged_(judged), loads_(p), document_(out) {
  document_.put(
      {{"format", "contct-result-1"}, {"title", p.title}, {"kernels", kernels}, {"engine", engine}});
  document_.open_array("steps");
}

void result_json::step_ended(const step_state& s) {
  const load total = loads_.at(s.step, s.fraction);
  std::vector<double> w;
  for (int node = 0; node < nodes(problem_.geometry); ++node)
    w.push_back(deflection_of(problem_, s.displacement, node));
  document_.open_object();
  document_.put({{"step", s.step}, {"fraction", s.fraction}});
  write_increments();
  document_.put("w", w);
  document_.put("displacement", s.displacement);
  write_pairs(s);
  write_reactions(s, total);
  write_elements(s, total);
  if (s.from_fallback) document_.put("ended_by", "oracle");
  document_.put({{"rcond", s.rcond},
                 {"digits", digits_left(s.rcond)},
                 {"certificate", certificate_json(judged_.steps().back())}});
  document_.close();
}

void result_json::write_increments() {
  document_.put_list("increments", increments_.size(), [this](std::size_t at) {
    const increment_record& i = increments_[at];
    json events = json::array();
    for (const event& e : i.events) events.push_back(event_json(problem_, e));
    json entry = {{"increment", i.number},
                  {"s", i.s},
                  {"fraction", i.fraction},
                  {"load", load_json(problem_.geometry, loads_, i.step, i.fraction)},
                  {"events", std::move(events)}};
    if (i.snaps) entry["snap"] = true;
    return entry;
  });
  increments_.clear();
}

void result_json::write_pairs(const step_state& s) {
  document_.put_list("pairs", problem_.pairs.size(), [&](std::size_t i) {
    const contact_pair& p = problem_.pairs[i];
    const double w = deflection_of(problem_, s.displacement, p.node);
    const pair_reading r = reading_of(p, w, s.isep[i] == in_contact);
    json entry = {{"pair", i + 1}};
    put_place(entry, problem_.geometry, p.node);
    entry.update({{"surface", surface_name(p.surface)},
                  {"state", state_name(s.isep[i])},
                  {"gap", r.gap},
                  {"force", r.force}});
    return entry;
  });
}

void result_json::write_reactions(const step_state& s, const load& total) {
  const std::vector<double> values = reactions(problem_.geometry, total, problem_.supports, s.displacement);
  const auto names = dof_names(problem_.geometry);
  document_.put_list("reactions", values.size(), [&](std::size_t i) {
    const support& at = problem_.supports[i];
    json entry;
    put_place(entry, problem_.geometry, at.node);
    if (!entry.contains("dof")) entry["dof"] = names[at.dof];
    entry["value"] = values[i];
    return entry;
  });
}

void result_json::write_elements(const step_state& s, const load& total) {
  const element_results results = results_in_elements(problem_.geometry, total, s.displacement);
  document_.put_list("elements", results.elements(), [&](std::size_t e) {
    json entry = {{"element", e + 1}};
    for (std::size_t i = 0; i < results.names.size(); ++i)
      entry[std::string(results.names[i])] = results.at(e, i);
    return entry;
  });
}

void result_json::finish(std::string_view status, const path_end& end, const lockstep* compared) {
  document_.close();  // the steps
  document_.put({{"end",
                  {{"reason", end_reason(end.status)},
                   {"step", end.step},
                   {"fraction", end.fraction},
                   {"pairs", numbered(end.pairs)}}},
                 {"engine_work",
                  {{"factors", end.work.factors},
                   {"solves", end.work.solves},
                   {"updates", end.work.updates},
                   {"checks", end.work.checks}}}});
  if (!free_runs_.empty())
    document_.put_list("free_run", free_runs_.size(), [this](std::size_t i) {
      const auto& [kernel, d, certified] = free_runs_[i];
      return json{{"kernel", kernel},
                  {"same_end", d.same_end},
                  {"same_events", d.same_events},
                  {"first_difference", d.first_difference},
                  {"fraction", d.fraction},
                  {"displacement", d.displacement},
                  {"bound", d.bound},
                  {"within_bound", d.within_bound()},
                  {"certified", certified}};
    });
  document_.put(
      {{"lockstep", compared == nullptr ? json(nullptr) : lockstep_json(*compared)}, {"status", status}});
  document_.finish();
}

}  // namespace contct::write
