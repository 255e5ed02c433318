#include "contct/serve/states.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "contct/write/words.hpp"

namespace contct::serve {
namespace {

using json = nlohmann::ordered_json;
constexpr std::size_t most_places = 240;
constexpr int words_width = 60;

/// Along a beam, evenly: places in every element where there are few.
std::vector<station> places_along(const beam& b) {
  const std::size_t elements = b.x.size() - 1;
  std::vector<station> places;
  if (elements > most_places) {
    for (const int node : evenly(b.x.size(), most_places)) places.push_back({node, 0.0});
    return places;
  }
  const int parts = static_cast<int>(std::clamp<std::size_t>(most_places / elements, 1, 24));
  for (int e = 0; e < static_cast<int>(elements); ++e)
    for (int i = 0; i < parts; ++i) places.push_back({e, static_cast<double>(i) / parts});
  places.push_back({static_cast<int>(elements), 0.0});
  return places;
}

class states_writer {
 public:
  explicit states_writer(const finished_run& r)
      : run_(r),
        p_(r.what),
        loads_(r.what),
        beam_(std::get_if<beam>(&r.what.geometry.kind)),
        deflecting_(deflecting_nodes(r.what)) {
    if (beam_ != nullptr) places_ = places_along(*beam_);
  }

  json whole() {
    json out = {{"kind", beam_ != nullptr                                  ? "beam"
                         : std::holds_alternative<plate>(p_.geometry.kind) ? "plate"
                                                                           : "matrix"},
                {"kernels", run_.kernels},
                {"comparison", run_.comparison},
                {"ended", run_.end},
                {"certified", certificate_summary(run_.judged, run_.status == "solved")},
                {"certified_whole", run_.status == "solved" && run_.judged.all_certified()},
                {"increments", run_.kept.increments()},
                {"x", json::array()},
                {"supports", json::array()},
                {"pairs", json::array()},
                {"frames", json::array()}};
    const std::vector<double> nothing(static_cast<std::size_t>(dofs(p_.geometry)), 0.0);
    for (const station& s : places_) out["x"].push_back(station_reader(*beam_, {}, nothing).x(s));
    put_supports(out["supports"]);
    for (std::size_t i = 0; i < p_.pairs.size(); ++i) {
      const contact_pair& at = p_.pairs[i];
      out["pairs"].push_back(
          {{"pair", i + 1}, {"x", x_of(at.node)}, {"face", at.face}, {"side", at.surface}});
    }
    for (const frame& f : run_.kept.frames()) out["frames"].push_back(frame_of(f));
    return out;
  }

 private:
  [[nodiscard]] double x_of(int node) const { return place_of_node(p_.geometry, node).x; }

  /// One entry a node, in the order in which nodes are first named.
  void put_supports(json& all) const {
    const auto names = dof_names(p_.geometry);
    std::vector<int> seen;
    for (const support& s : p_.supports) {
      const auto at = std::ranges::find(seen, s.node) - seen.begin();
      if (at == std::ssize(seen)) {
        seen.push_back(s.node);
        all.push_back({{"x", x_of(s.node)}, {"dofs", json::array()}});
      }
      all[static_cast<std::size_t>(at)]["dofs"].push_back(names[s.dof]);
    }
  }

  /// At the places. A fine mesh is read at its nodes alone: lines inside elements cost more than the path.
  [[nodiscard]] std::vector<double> deflections_of(const frame& f) const {
    std::vector<double> w;
    if (std::ranges::all_of(places_, [](const station& s) { return s.share == 0.0; })) {
      for (const station& s : places_) w.push_back(deflection_of(p_, f, s.node));
      return w;
    }
    const station_reader reader(*beam_, f.step == 0 ? load() : loads_.at(f.step, f.fraction), f.displacement);
    for (const station& s : places_) w.push_back(reader.w(s));
    return w;
  }

  [[nodiscard]] json frame_of(const frame& f) const {
    json out = {{"step", f.step},
                {"number", f.number},
                {"fraction", f.fraction},
                {"end", f.step_end},
                {"load", f.step == 0 ? "none" : loads_.words_at(f.step, f.fraction, words_width)},
                {"largest", largest_deflection(p_, f, deflecting_).value},
                {"events", json::array()}};
    for (const event& e : f.events)
      out["events"].push_back({{"pair", e.pair + 1}, {"change", change_name(e.what)}});
    std::string looks;
    for (std::size_t i = 0; i < p_.pairs.size(); ++i)
      looks += "ocf"[static_cast<int>(reading_of(p_, f, i).look)];
    out["looks"] = looks;
    if (beam_ == nullptr) return out;
    out["w"] = deflections_of(f);
    return out;
  }

  const finished_run& run_;
  const problem& p_;
  load_path loads_;
  const beam* beam_;
  std::vector<int> deflecting_;
  std::vector<station> places_;
};

}  // namespace

std::string states_json(const finished_run& r) {
  return json_text(states_writer(r).whole());
}

}  // namespace contct::serve
