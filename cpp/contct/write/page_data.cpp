// What the page of a run draws from, as JSON.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "contct/write/certificate_text.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/json_document.hpp"
#include "contct/write/load_text.hpp"
#include "contct/write/mesh_page.hpp"
#include "contct/write/page_sampling.hpp"
#include "contct/write/run_page.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

constexpr int load_words_width = 60;

/// A node as the page names it: its number, from 1, or its label.
json named(const problem& p, int node) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return place_name(p.geometry, node);
  return node + 1;
}

/// The events of an increment: [pair, node, side, 1 for make], numbers from 1.
json events_json(const problem& p, const std::vector<event>& events) {
  json list = json::array();
  for (std::size_t i = 0; i < std::min(events.size(), most_events); ++i) {
    const contact_pair& at = p.pairs[events[i].pair];
    list.push_back(
        {events[i].pair + 1, named(p, at.node), at.surface, events[i].what == change::make ? 1 : 0});
  }
  return list;
}

json supports_json(const problem& p, const shown_parts& shown, const std::optional<mesh_page>& mesh) {
  const auto names = dof_names(p.geometry);
  std::map<int, json> at;
  for (const support& s : p.supports) {
    if (!std::binary_search(shown.supports.begin(), shown.supports.end(), s.node)) continue;
    const place where = place_of_node(p.geometry, s.node);
    json& entry = at[s.node];
    if (entry.is_null())
      entry = {{"node", named(p, s.node)}, {"x", where.x}, {"y", where.y}, {"dofs", json::array()}};
    entry["dofs"].push_back({names[s.dof], s.fixed ? json(nullptr) : json(s.spring)});
  }
  json list = json::array();
  for (auto& [node, entry] : at) {
    if (mesh) mesh->place(node, entry);
    list.push_back(std::move(entry));
  }
  return list;
}

json pairs_json(const problem& p, const shown_parts& shown, const std::optional<mesh_page>& mesh) {
  json list = json::array();
  for (const int i : shown.pairs) {
    const contact_pair& at = p.pairs[i];
    const place where = place_of_node(p.geometry, at.node);
    json entry = {
        {"pair", i + 1},   {"node", named(p, at.node)}, {"x", where.x}, {"y", where.y}, {"side", at.surface},
        {"face", at.face}, {"stiffness", at.stiffness}};
    if (mesh) mesh->place(at.node, entry);
    list.push_back(std::move(entry));
  }
  return list;
}

json geometry_json(const problem& p, const shown_parts& shown, const std::optional<mesh_page>& mesh) {
  json out = {{"kind", "none"}};
  const auto lines = [](const std::vector<double>& all, const std::vector<int>& chosen) {
    json list = json::array();
    for (const int i : chosen) list.push_back(all[i]);
    return list;
  };
  const auto numbered = [](const std::vector<int>& chosen) {
    json list = json::array();
    for (const int i : chosen) list.push_back(i + 1);
    return list;
  };
  if (const auto* b = std::get_if<beam>(&p.geometry.kind)) {
    out = {{"kind", "beam"}, {"x", lines(b->x, shown.nodes)}, {"nodes", numbered(shown.nodes)}};
  } else if (const auto* plate_of = std::get_if<plate>(&p.geometry.kind)) {
    out = {{"kind", "plate"},
           {"x", lines(plate_of->x, shown.columns)},
           {"y", lines(plate_of->y, shown.rows)},
           {"columns", numbered(shown.columns)},
           {"rows", numbered(shown.rows)},
           {"all_columns", plate_of->columns()}};
  } else if (mesh) {
    out = mesh->geometry();
  }
  out["watched"] = named(p, shown.watched);
  return out;
}

json point_loads_json(const problem& p, const load& l) {
  json list = json::array();
  for (std::size_t i = 0; i < std::min(most_loads, l.points.size()); ++i) {
    const point_load& at = l.points[i];
    const place where = place_of_node(p.geometry, at.node);
    list.push_back({where.x, where.y, at.dof, at.value, at.node + 1});
  }
  return list;
}

/// A quantity just left and just right of each node shown, and the largest of it at any node.
json section_force_json(const element_results& results, std::size_t name, const std::vector<int>& nodes) {
  const auto elements = static_cast<int>(results.elements());
  const auto at = [&](int element, int end) {
    return element < 0 || element >= elements ? json(nullptr) : json(results.at(element, name)[end]);
  };
  json left = json::array();
  json right = json::array();
  for (const int node : nodes) {
    left.push_back(at(node - 1, 1));
    right.push_back(at(node, 0));
  }
  extreme most;
  for (int e = 0; e < elements; ++e) {
    for (int end = 0; end < 2; ++end) most.take(e + end, results.at(e, name)[end]);
  }
  return {
      {"left", std::move(left)}, {"right", std::move(right)}, {"largest", most.value}, {"node", most.at + 1}};
}

/// Deflection and slope at the nodes shown, moment and shear, and force per length for arrows.
void add_beam_shape(const beam& b, const problem& p, const load& l, const frame& f, const shown_parts& shown,
                    json& out) {
  json w = json::array();
  json slope = json::array();
  for (const int node : shown.nodes) {
    w.push_back(deflection_of(p, f, node));
    slope.push_back(f.displacement[2 * node + 1]);
  }
  out["w"] = std::move(w);
  out["slope"] = std::move(slope);
  const element_results results = results_in_elements(p.geometry, l, f.displacement);
  for (std::size_t name = 0; name < 2; ++name)
    out[std::string(results.names[name])] = section_force_json(results, name, shown.nodes);
  out["q"] = l.distributed.empty() ? json(nullptr) : json(sampled_load(b, l));
}

/// Deflections at the crossings of the grid lines shown, row by row.
void add_plate_shape(const plate& of, const problem& p, const frame& f, const shown_parts& shown, json& out) {
  json w = json::array();
  for (const int j : shown.rows) {
    for (const int i : shown.columns) w.push_back(deflection_of(p, f, of.node_at(i, j)));
  }
  out["w"] = std::move(w);
}

void add_pairs(const problem& p, const frame& f, const shown_parts& shown, json& out) {
  std::string looks;
  json w = json::array();
  json closed = json::array();
  for (const int i : shown.pairs) {
    const pair_reading r = reading_of(p, f, i);
    looks += r.look == pair_look::open ? 'o' : r.look == pair_look::closed ? 'c' : 'f';
    closed.push_back(f.closed(i) ? 1 : 0);
    w.push_back(r.w);
  }
  const pair_counts n = count_pairs(p, f);
  out["looks"] = looks;
  out["closed"] = std::move(closed);
  out["at_pairs"] = std::move(w);
  out["counts"] = {n.open, n.closed, n.at_face};
}

json frame_json(const finished_run& r, const load_path& loads, const frame& f, const shown_parts& shown,
                const std::optional<mesh_page>& mesh) {
  const load l = loads.at(f.step, f.fraction);
  const extreme most = largest_deflection(r.what, f, shown.deflecting);
  json out = {{"at", f.at},
              {"step", f.step},
              {"number", f.number},
              {"fraction", f.fraction},
              {"s", f.s},
              {"snap", f.snaps},
              {"end", f.step_end},
              {"rescued", f.from_fallback},
              {"load", f.step == 0 ? "none" : loads.words_at(f.step, f.fraction, load_words_width)},
              {"force", resultant_of(r.what.geometry, l).force},
              {"largest", {{"w", most.value}, {"node", named(r.what, most.at)}}},
              {"watched", deflection_of(r.what, f, shown.watched)},
              {"events", events_json(r.what, f.events)},
              {"all_events", f.events.size()}};
  const auto* const b = std::get_if<beam>(&r.what.geometry.kind);
  const auto* const plate_of = std::get_if<plate>(&r.what.geometry.kind);
  if (b != nullptr) add_beam_shape(*b, r.what, l, f, shown, out);
  if (plate_of != nullptr) add_plate_shape(*plate_of, r.what, f, shown, out);
  if (b != nullptr || plate_of != nullptr) out["points"] = point_loads_json(r.what, l);
  add_pairs(r.what, f, shown, out);
  if (mesh) {
    out["u"] = mesh->displacements(f);
    out["points"] = mesh->points(l);
  }
  return out;
}

json increments_json(const finished_run& r, const load_path& loads) {
  json list = json::array();
  for (const increment_record& i : r.record.increments) {
    list.push_back({{"step", i.step},
                    {"number", i.number},
                    {"s", i.s},
                    {"fraction", i.fraction},
                    {"snap", i.snaps},
                    {"load", loads.words_at(i.step, i.fraction, load_words_width)},
                    {"events", events_json(r.what, i.events)},
                    {"all_events", i.events.size()}});
  }
  return list;
}

json calls_json(const finished_run& r) {
  json list = json::array();
  for (const call_record& c : r.record.calls) {
    json followers = json::array();
    for (const follower_answer& a : c.followers)
      followers.push_back({a.values, a.mismatches, a.smin_ulps, a.ss_ulps, a.failed ? 1 : 0});
    list.push_back({{"step", c.step},
                    {"number", c.number},
                    {"smin", c.smin},
                    {"ss", c.ss},
                    {"followers", std::move(followers)}});
  }
  return list;
}

json certificates_json(const finished_run& r) {
  json list = json::array();
  for (const auto& c : r.judged.steps()) {
    list.push_back({{"mark", certificate_mark(c)}, {"numbers", certificate_json(c)}});
  }
  return list;
}

}  // namespace

nlohmann::ordered_json page_data(const finished_run& r) {
  const load_path loads(r.what);
  const shown_parts shown = choose_parts(r);
  std::optional<mesh_page> mesh;
  if (const auto* a = std::get_if<assembled>(&r.what.geometry.kind))
    if (a->places.known()) mesh.emplace(*a, shown);
  json out = {{"format", "contct-page-1"},
              {"title", title_of(r)},
              {"facts", r.facts},
              {"kernels", r.kernels},
              {"engine", r.engine},
              {"status", r.status},
              {"ended", r.end},
              {"lockstep", r.in_lockstep},
              {"equal", r.kernels.size() < 2 ? json(nullptr) : json(r.equal)},
              {"comparison", r.comparison},
              {"place", node_name(r.what.geometry)},
              {"nodes", nodes(r.what.geometry)},
              {"elements", elements(r.what.geometry)},
              {"all_pairs", r.what.pairs.size()},
              {"all_steps", r.what.steps.size()},
              {"all_increments", r.record.all_increments},
              {"all_calls", r.record.all_calls},
              {"geometry", geometry_json(r.what, shown, mesh)},
              {"supports", supports_json(r.what, shown, mesh)},
              {"pairs", pairs_json(r.what, shown, mesh)},
              {"increments", increments_json(r, loads)},
              {"calls", calls_json(r)},
              {"log", r.record.log},
              {"certificates", certificates_json(r)},
              {"certified", certificate_summary(r.judged)},
              {"uncertified", certificate_complaints(r.what, r.judged, r.early)},
              {"thinned", shown.omissions}};
  json frames = json::array();
  for (const frame& f : r.kept.frames()) frames.push_back(frame_json(r, loads, f, shown, mesh));
  out["frames"] = std::move(frames);
  return out;
}

/// In a script element only "<" can begin anything.
std::string page_data_for_script(const finished_run& r) {
  std::string safe;
  for (const char c : page_data(r).dump(-1, ' ', false, json::error_handler_t::replace)) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace contct::write
