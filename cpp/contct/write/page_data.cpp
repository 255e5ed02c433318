#include "contct/write/page_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/certificate_text.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/load_text.hpp"
#include "contct/write/mesh_page.hpp"
#include "contct/write/page_sampling.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

constexpr std::size_t most_events = 60;  // of an increment
constexpr std::size_t most_points = 60;  // loads that are drawn
constexpr int load_samples = 25;         // along a beam
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
    const contact_pair& at = p.pairs[static_cast<std::size_t>(events[i].pair)];
    list.push_back(
        {events[i].pair + 1, named(p, at.node), at.surface, events[i].what == change::make ? 1 : 0});
  }
  return list;
}

json supports_json(const problem& p, const shown_parts& shown) {
  const auto names = dof_names(p.geometry);
  std::map<int, json> at;
  for (const support& s : p.supports) {
    if (!std::binary_search(shown.supports.begin(), shown.supports.end(), s.node)) continue;
    const place where = place_of_node(p.geometry, s.node);
    json& entry = at[s.node];
    if (entry.is_null())
      entry = {{"node", named(p, s.node)}, {"x", where.x}, {"y", where.y}, {"dofs", json::array()}};
    entry["dofs"].push_back(
        {names[static_cast<std::size_t>(s.dof)], s.fixed ? json(nullptr) : json(s.spring)});
  }
  json list = json::array();
  for (auto& [node, entry] : at) list.push_back(std::move(entry));
  return list;
}

json pairs_json(const problem& p, const shown_parts& shown) {
  json list = json::array();
  for (const std::size_t i : shown.pairs) {
    const contact_pair& at = p.pairs[i];
    const place where = place_of_node(p.geometry, at.node);
    list.push_back({{"pair", i + 1},
                    {"node", named(p, at.node)},
                    {"x", where.x},
                    {"y", where.y},
                    {"side", at.surface},
                    {"face", at.face},
                    {"stiffness", at.stiffness}});
  }
  return list;
}

json geometry_json(const finished_run& r, const shown_parts& shown) {
  const problem& p = r.what;
  json out = json::object();
  const auto lines = [](const std::vector<double>& all, const std::vector<int>& chosen) {
    json list = json::array();
    for (const int i : chosen) list.push_back(all[static_cast<std::size_t>(i)]);
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
  } else {
    out = mesh_json(r, shown);
  }
  out["watched"] = named(p, static_cast<int>(shown.watched));
  return out;
}

/// Force per length at evenly spaced places along the beam, for arrows.
json distributed_json(const beam& b, const load& l) {
  if (l.distributed.empty()) return nullptr;
  json list = json::array();
  for (int i = 0; i < load_samples; ++i) {
    const double x = b.x.front() + (b.x.back() - b.x.front()) * i / (load_samples - 1);
    const auto right = std::upper_bound(b.x.begin() + 1, b.x.end() - 1, x);
    const int element = static_cast<int>(right - b.x.begin()) - 1;
    double q = 0.0;
    for (const distributed_load& d : l.distributed) {
      const bool here =
          d.elements.empty() || std::find(d.elements.begin(), d.elements.end(), element) != d.elements.end();
      double power = 1.0;
      for (const double a : d.polynomial) {
        if (here) q += a * power;
        power *= x;
      }
    }
    list.push_back(q);
  }
  return list;
}

json point_loads_json(const problem& p, const load& l) {
  json list = json::array();
  for (std::size_t i = 0; i < std::min(most_points, l.points.size()); ++i) {
    const point_load& at = l.points[i];
    const place where = place_of_node(p.geometry, at.node);
    list.push_back({where.x, where.y, at.dof, at.value, at.node + 1});
  }
  return list;
}

/// Deflection and slope at the nodes shown; moment and shear just left and just right of each.
void add_beam_shape(const problem& p, const load& l, const frame& f, const shown_parts& shown, json& out) {
  json w = json::array();
  json slope = json::array();
  json sides[2][2] = {{json::array(), json::array()}, {json::array(), json::array()}};
  const element_results results = results_in_elements(p.geometry, l, f.displacement);
  const auto elements = static_cast<int>(results.elements());
  for (const int node : shown.nodes) {
    w.push_back(f.displacement[static_cast<std::size_t>(node) * 2]);
    slope.push_back(f.displacement[static_cast<std::size_t>(node) * 2 + 1]);
    for (std::size_t name = 0; name < 2; ++name) {
      const auto at = [&](int element, std::size_t end) {
        return element < 0 || element >= elements
                   ? json(nullptr)
                   : json(results.at(static_cast<std::size_t>(element), name)[end]);
      };
      sides[name][0].push_back(at(node - 1, 1));
      sides[name][1].push_back(at(node, 0));
    }
  }
  out["w"] = std::move(w);
  out["slope"] = std::move(slope);
  for (std::size_t name = 0; name < 2; ++name) {
    extreme most;
    for (int e = 0; e < elements; ++e) {
      for (std::size_t end = 0; end < 2; ++end) {
        const double value = results.at(static_cast<std::size_t>(e), name)[end];
        if (std::abs(value) > std::abs(most.value)) most = {static_cast<std::size_t>(e) + end, value};
      }
    }
    out[std::string(results.names[name])] = {{"left", std::move(sides[name][0])},
                                             {"right", std::move(sides[name][1])},
                                             {"largest", most.value},
                                             {"node", most.at + 1}};
  }
}

void add_shape(const problem& p, const load& l, const frame& f, const shown_parts& shown, json& out) {
  if (const auto* b = std::get_if<beam>(&p.geometry.kind)) {
    add_beam_shape(p, l, f, shown, out);
    out["q"] = distributed_json(*b, l);
  } else if (const auto* plate_of = std::get_if<plate>(&p.geometry.kind)) {
    json w = json::array();
    for (const int j : shown.rows) {
      for (const int i : shown.columns)
        w.push_back(deflection_of(p, f, static_cast<std::size_t>(plate_of->node_at(i, j))));
    }
    out["w"] = std::move(w);
  } else {
    return;
  }
  out["points"] = point_loads_json(p, l);
}

void add_pairs(const problem& p, const frame& f, const shown_parts& shown, json& out) {
  std::string looks;
  json w = json::array();
  json closed = json::array();
  for (const std::size_t i : shown.pairs) {
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

json frame_json(const finished_run& r, const load_path& loads, const frame& f, const shown_parts& shown) {
  const load l = load_of(loads, f);
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
              {"largest", {{"w", most.value}, {"node", named(r.what, static_cast<int>(most.at))}}},
              {"watched", deflection_of(r.what, f, shown.watched)},
              {"events", events_json(r.what, f.events)},
              {"all_events", f.events.size()}};
  add_shape(r.what, l, f, shown, out);
  add_pairs(r.what, f, shown, out);
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
    json entry = {{"mark", certificate_mark(c)}, {"numbers", certificate_json(c)}};
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace

nlohmann::ordered_json page_data(const finished_run& r) {
  const load_path loads(r.what);
  const shown_parts shown = choose_parts(r);
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
              {"geometry", geometry_json(r, shown)},
              {"supports", supports_json(r.what, shown)},
              {"pairs", pairs_json(r.what, shown)},
              {"increments", increments_json(r, loads)},
              {"calls", calls_json(r)},
              {"log", r.record.log},
              {"certificates", certificates_json(r)},
              {"certified", certificate_summary(r.judged)},
              {"uncertified", certificate_complaints(r.what, r.judged, r.early)},
              {"thinned", shown.said}};
  json frames = json::array();
  for (const frame& f : r.kept.frames()) frames.push_back(frame_json(r, loads, f, shown));
  if (std::holds_alternative<assembled>(r.what.geometry.kind)) add_mesh(r, loads, shown, out, frames);
  out["frames"] = std::move(frames);
  return out;
}

}  // namespace contct
