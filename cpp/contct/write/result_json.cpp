#include "contct/write/result_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/certificate_text.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

std::string_view end_reason(path_status status) {
  switch (status) {
    case path_status::solved:
      return "all load applied";
    case path_status::mechanism:
      return "mechanism";
    case path_status::cycle:
      return "cycle";
    case path_status::iteration_limit:
      return "iteration limit";
    case path_status::not_factored:
      return "not factored";
  }
  return "";
}

/// "node": 3, or "dof": "185.3" where each dof is a node of its own.
void put_place(json& entry, const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  if (a != nullptr) {
    entry["dof"] = a->label_of(node);
  } else {
    entry["node"] = node + 1;
  }
}

json numbered(const std::vector<int>& pairs) {
  json list = json::array();
  for (const int pair : pairs) list.push_back(pair + 1);
  return list;
}

}  // namespace

std::string_view surface_name(int surface) {
  return surface == face_above ? "above" : "below";
}

std::string_view change_name(change c) {
  return c == change::make ? "make" : "break";
}

std::string_view status_name(path_status status) {
  switch (status) {
    case path_status::solved:
      return "solved";
    case path_status::mechanism:
      return "mechanism";
    default:
      return "iteration-limit";
  }
}

result_json::result_json(const problem& p, const std::vector<std::string>& kernels, std::string_view engine,
                         const certifier& judged, output_file& out)
    : problem_(p), judged_(judged), loads_(p), out_(out) {
  out_.write(
      fmt::format("{{\n  \"format\": \"contct-result-1\",\n  \"title\": {},\n  \"kernels\": {},\n"
                  "  \"engine\": {},\n  \"steps\": [",
                  json(p.title).dump(), json(kernels).dump(), json(engine).dump()));
}

void result_json::incremented(const increment& i) {
  json events = json::array();
  for (const event& e : i.events) {
    const contact_pair& p = problem_.pairs[static_cast<std::size_t>(e.pair)];
    json words = {{"pair", e.pair + 1}};
    put_place(words, problem_.geometry, p.node);
    words["surface"] = surface_name(p.surface);
    words["change"] = change_name(e.what);
    events.push_back(std::move(words));
  }
  json entry = {{"increment", i.number},
                {"s", i.s},
                {"fraction", i.fraction},
                {"load", loads_.json_at(i.step, i.fraction)},
                {"events", std::move(events)}};
  if (i.snaps) entry["snap"] = true;
  increments_.push_back(entry.dump());
}

template <class Entry>
void result_json::write_list(std::string_view name, std::size_t count, Entry entry, bool last) {
  out_.write(fmt::format("      \"{}\": [", name));
  for (std::size_t i = 0; i < count; ++i)
    out_.write(fmt::format("{}\n        {}", i == 0 ? "" : ",", entry(i)));
  out_.write(fmt::format("{}]{}\n", count == 0 ? "" : "\n      ", last ? "" : ","));
}

void result_json::step_ended(const step_state& s) {
  const load total = loads_.at(s.step, s.fraction);
  std::vector<double> w;
  const auto stride = static_cast<std::size_t>(dofs_per_node(problem_.geometry));
  for (std::size_t i = 0; i < s.displacement.size(); i += stride) w.push_back(s.displacement[i]);

  out_.write(fmt::format("{}\n    {{\n      \"step\": {},\n      \"fraction\": {},\n", first_step_ ? "" : ",",
                         s.step, json(s.fraction).dump()));
  first_step_ = false;
  write_list("increments", increments_.size(), [this](std::size_t i) { return increments_[i]; });
  increments_.clear();
  out_.write(fmt::format("      \"w\": {},\n", json(w).dump()));
  out_.write(fmt::format("      \"displacement\": {},\n",
                         json(std::vector<double>(s.displacement.begin(), s.displacement.end())).dump()));
  write_pairs(s);
  write_reactions(s, total);
  write_elements(s, total);
  if (s.from_fallback) out_.write("      \"ended_by\": \"oracle\",\n");
  out_.write(fmt::format("      \"rcond\": {},\n      \"digits\": {},\n      \"certificate\": {}\n    }}",
                         json(s.rcond).dump(), digits_left(s.rcond),
                         certificate_json(judged_.steps().back()).dump()));
}

void result_json::write_pairs(const step_state& s) {
  const auto stride = static_cast<std::size_t>(dofs_per_node(problem_.geometry));
  write_list("pairs", problem_.pairs.size(), [&](std::size_t i) {
    const contact_pair& p = problem_.pairs[i];
    const double w = s.displacement[static_cast<std::size_t>(p.node) * stride];
    const bool closed = s.isep[i] == in_contact;
    json entry = {{"pair", i + 1}};
    put_place(entry, problem_.geometry, p.node);
    entry["surface"] = surface_name(p.surface);
    entry["state"] = closed ? "contact" : "separated";
    entry["gap"] = gap_of(p, w, closed);
    entry["force"] = force_of(p, w, closed);
    return entry.dump();
  });
}

void result_json::write_reactions(const step_state& s, const load& total) {
  const std::vector<double> values = reactions(problem_.geometry, total, problem_.supports, s.displacement);
  const auto names = dof_names(problem_.geometry);
  write_list("reactions", values.size(), [&](std::size_t i) {
    const support& at = problem_.supports[i];
    json entry;
    put_place(entry, problem_.geometry, at.node);
    if (!entry.contains("dof")) entry["dof"] = names[static_cast<std::size_t>(at.dof)];
    entry["value"] = values[i];
    return entry.dump();
  });
}

void result_json::write_elements(const step_state& s, const load& total) {
  const element_results results = results_in_elements(problem_.geometry, total, s.displacement);
  write_list("elements", results.elements(), [&](std::size_t e) {
    json entry = {{"element", e + 1}};
    for (std::size_t i = 0; i < results.names.size(); ++i)
      entry[std::string(results.names[i])] = results.at(e, i);
    return entry.dump();
  });
}

void result_json::add_free_run(std::string_view kernel, const free_run_difference& d, bool certified) {
  const json entry = {{"kernel", kernel},
                      {"same_end", d.same_end},
                      {"same_events", d.same_events},
                      {"first_difference", d.first_difference},
                      {"fraction", d.fraction},
                      {"displacement", d.displacement},
                      {"bound", d.bound},
                      {"within_bound", d.within_bound()},
                      {"certified", certified}};
  free_runs_.push_back(entry.dump());
}

void result_json::finish(std::string_view status, const path_end& end, const lockstep* compared) {
  json lock;
  if (compared != nullptr) {
    lock = {{"calls", compared->calls()},
            {"values_compared", compared->compared().values},
            {"mismatches", compared->compared().mismatches}};
    if (compared->first()) {
      const mismatch_report& d = *compared->first();
      lock["first"] = {{"call", d.call},         {"kernel", d.follower},     {"field", d.where.field},
                       {"index", d.where.index}, {"leader", d.where.leader}, {"follower", d.where.follower},
                       {"ulps", d.where.ulps}};
    }
  }
  const json how = {{"reason", end_reason(end.status)},
                    {"step", end.step},
                    {"fraction", end.fraction},
                    {"pairs", numbered(end.pairs)}};
  out_.write(fmt::format("\n  ],\n  \"end\": {},\n", how.dump()));
  const engine_counts& work = end.work;
  out_.write(fmt::format("  \"engine_work\": {},\n", json({{"factors", work.factors},
                                                           {"solves", work.solves},
                                                           {"updates", work.updates},
                                                           {"checks", work.checks}})
                                                         .dump()));
  if (!free_runs_.empty()) out_.write(fmt::format("  \"free_run\": [{}],\n", fmt::join(free_runs_, ", ")));
  out_.write(fmt::format("  \"lockstep\": {},\n  \"status\": {}\n}}\n", lock.dump(), json(status).dump()));
  out_.finish();
}

}  // namespace contct
