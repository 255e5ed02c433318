#include "contct/write/result_json.hpp"

#include <nlohmann/json.hpp>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/frame_numbers.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

json event_json(const problem& p, const event& e) {
  const contact_pair& at = p.pairs[e.pair];
  json entry = {{"pair", e.pair + 1}};
  put_place(entry, p.geometry, at.node);
  entry["surface"] = surface_name(at.surface);
  entry["change"] = change_name(e.what);
  return entry;
}

json numbered(const std::vector<int>& pairs) {
  json list = json::array();
  for (const int pair : pairs) list.push_back(pair + 1);
  return list;
}

json lockstep_json(const lockstep& compared) {
  json out = {{"calls", compared.calls()},
              {"values_compared", compared.compared().values},
              {"mismatches", compared.compared().mismatches}};
  if (compared.first()) {
    const mismatch_report& d = *compared.first();
    out["first"] = {{"call", d.call},         {"kernel", d.follower},     {"field", d.where.field},
                    {"index", d.where.index}, {"leader", d.where.leader}, {"follower", d.where.follower},
                    {"ulps", d.where.ulps}};
  }
  return out;
}

}  // namespace

result_json::result_json(const problem& p, const std::vector<std::string>& kernels, std::string_view engine,
                         const certifier& judged, output_file& out)
    : problem_(p), judged_(judged), loads_(p), document_(out) {
  document_.put("format", "contct-result-1");
  document_.put("title", p.title);
  document_.put("kernels", kernels);
  document_.put("engine", engine);
  document_.open_array("steps");
}

void result_json::step_ended(const step_state& s) {
  const load total = loads_.at(s.step, s.fraction);
  std::vector<double> w;
  w.reserve(nodes(problem_.geometry));
  for (int node = 0; node < nodes(problem_.geometry); ++node)
    w.push_back(deflection_of(problem_, s.displacement, node));
  document_.open_object();
  document_.put("step", s.step);
  document_.put("fraction", s.fraction);
  write_increments();
  document_.put("w", w);
  document_.put("displacement", s.displacement);
  write_pairs(s);
  write_reactions(s, total);
  write_elements(s, total);
  if (s.from_fallback) document_.put("ended_by", "oracle");
  document_.put("rcond", s.rcond);
  document_.put("digits", digits_left(s.rcond));
  document_.put("certificate", certificate_json(judged_.steps().back()));
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
    entry["surface"] = surface_name(p.surface);
    entry["state"] = state_name(s.isep[i]);
    entry["gap"] = r.gap;
    entry["force"] = r.force;
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
  document_.put("end", {{"reason", end_reason(end.status)},
                        {"step", end.step},
                        {"fraction", end.fraction},
                        {"pairs", numbered(end.pairs)}});
  document_.put("engine_work", {{"factors", end.work.factors},
                                {"solves", end.work.solves},
                                {"updates", end.work.updates},
                                {"checks", end.work.checks}});
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
  document_.put("lockstep", compared == nullptr ? json(nullptr) : lockstep_json(*compared));
  document_.put("status", status);
  document_.finish();
}

}  // namespace contct::write
