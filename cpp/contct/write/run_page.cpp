#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "contct/path/solve_problem.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/input_tables.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/run_tables.hpp"
#include "contct/write/words.hpp"

namespace contct::write {

// Files of report/ and reference/parallel-edition.html, built in: embed.cmake writes them.
extern const std::string_view report_html, report_css, report_js, parallel_edition_html;

namespace {

using json = nlohmann::ordered_json;

constexpr int load_words_width = 60;

/// A node as the page names it: its number, from 1, or its label.
json named(const problem& p, int node) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return place_name(p.geometry, node);
  return node + 1;
}

json extreme_json(const placed_value& v) {
  return {{"value", v.value}, {"x", v.x}, {"node", v.node < 0 ? json(nullptr) : json(v.node + 1)}};
}

/// A number for a colour: four digits are enough, and keep the page small. None has no colour.
json for_colour(double x) {
  if (!std::isfinite(x)) return nullptr;
  return json::parse(fmt::format("{:.4g}", x));
}

/// What is wrong with final states, and what to do about it.
std::vector<std::string> complaints_of(const finished_run& r) {
  std::vector<std::string> lines = certificate_complaints(r.what, r.judged, r.early);
  const std::string remedy = remedy_words(r.kernels, r.file);
  if (!lines.empty() && !remedy.empty()) lines.push_back(remedy);
  return lines;
}

json calls_json(const run_record& record) {
  const auto answer = [](const follower_answer& a) -> json {
    return {a.values, a.mismatches, a.smin_ulps, a.ss_ulps, a.failed ? 1 : 0};
  };
  return list_of(record.calls, [&](const call_record& c) -> json {
    return {{"step", c.step},
            {"number", c.number},
            {"smin", c.smin},
            {"ss", c.ss},
            {"followers", list_of(c.followers, answer)}};
  });
}

/// Puts together what the page draws from.
class page_writer {
 public:
  explicit page_writer(const finished_run& r)
      : run_(r), what_(r.what), loads_(r.what), shown_(choose_parts(r)) {
    input_ = input_tables(what_, shown_.omissions);
    ends_ = result_tables(r, shown_.deflecting, shown_.omissions);
    envelope_ = envelope_tables(r, shown_.omissions);
    const auto* const a = std::get_if<assembled>(&what_.geometry.kind);
    if (a == nullptr || !a->places.known()) return;
    mesh_ = a;
    of_node_ = dofs_of_nodes(a->places);
    axes_ = axes_of(a->places);
    number_.assign(a->places.nodes.size(), -1);
    for (int i = 0; const int node : shown_.nodes) number_[node] = i++;
  }

  [[nodiscard]] json whole() const {
    const finished_run& r = run_;
    return {
        {"format", "contct-page-1"},
        {"title", title_of(r)},
        {"file", r.file},
        {"date", r.date},
        {"units", units()},
        {"facts", r.facts},
        {"kernels", r.kernels},
        {"engine", r.engine},
        {"status", r.status},
        {"ended", r.end},
        {"lockstep", r.in_lockstep},
        {"equal", r.kernels.size() < 2 ? json(nullptr) : json(r.equal)},
        {"comparison", r.comparison},
        {"place", node_name(what_.geometry)},
        {"nodes", nodes(what_.geometry)},
        {"elements", elements(what_.geometry)},
        {"all_pairs", what_.pairs.size()},
        {"all_steps", what_.steps.size()},
        {"all_increments", r.record.all_increments},
        {"all_calls", r.record.all_calls},
        {"geometry", geometry()},
        {"supports", supports()},
        {"pairs", list_of(shown_.pairs, [this](int i) { return pair(i); })},
        {"increments", list_of(r.record.increments, [this](const auto& i) { return increment_of(i); })},
        {"calls", calls_json(r.record)},
        {"log", r.record.log},
        {"certificates", list_of(r.judged.steps(),
                                 [](const auto& c) -> json {
                                   return {{"mark", certificate_mark(c)}, {"numbers", certificate_json(c)}};
                                 })},
        {"certified", certificate_summary(r.judged, r.status == "solved")},
        {"certified_whole", r.status == "solved" && r.judged.all_certified()},
        {"uncertified", complaints_of(r)},
        {"input", input_},
        {"ends", ends_},
        {"envelope", envelope_},
        {"thinned", shown_.omissions},
        {"frames", list_of(r.kept.frames(), [this](const frame& f) { return frame_of(f); })}};
  }

 private:
  [[nodiscard]] json geometry() const {
    json out = {{"kind", "none"}};
    const auto lines = [](const std::vector<double>& all, const std::vector<int>& chosen) {
      return list_of(chosen, [&](int i) { return all[i]; });
    };
    const auto numbered = [](const std::vector<int>& chosen) {
      return list_of(chosen, [](int i) { return i + 1; });
    };
    if (beam_ != nullptr) out = beam_geometry();
    if (plate_ != nullptr)
      out = {{"kind", "plate"},
             {"x", lines(plate_->x, shown_.columns)},
             {"y", lines(plate_->y, shown_.rows)},
             {"columns", numbered(shown_.columns)},
             {"rows", numbered(shown_.rows)},
             {"all_columns", plate_->columns()}};
    if (mesh_ != nullptr) out = mesh_geometry();
    out["watched"] = named(what_, shown_.watched);
    return out;
  }

  /// What goes behind numbers of each kind; nothing where the problem has no units.
  [[nodiscard]] json units() const {
    if (what_.units.force.empty()) return json::object();
    const auto unit = [this](int force, int length) { return unit_words(what_.units, force, length); };
    json out = {{"w", unit(0, 1)},     {"force", unit(1, 0)},     {"moment", unit(1, 1)},
                {"shear", unit(1, 0)}, {"pressure", unit(1, -2)}, {"per_length", unit(1, -1)}};
    if (plate_ != nullptr)
      for (const char* moment : {"mx", "my", "mxy"}) out[moment] = unit_words(what_, moment).substr(1);
    return out;
  }

  /// Stations along it, with the numbers of those that are nodes; from where to where a distributed load goes
  /// without a jump, and at how many places of each such piece frames have it.
  [[nodiscard]] json beam_geometry() const {
    const std::vector<double> no_displacement(beam_->dofs());
    const station_reader at(*beam_, {}, no_displacement);
    return {{"kind", "beam"},
            {"x", list_of(shown_.stations, [&](const station& s) { return at.x(s); })},
            {"nodes",
             list_of(shown_.stations,
                     [](const station& s) { return s.share == 0.0 ? json(s.node + 1) : json(nullptr); })},
            {"loaded", list_of(shown_.loaded,
                               [this](const load_piece& p) -> json {
                                 return {beam_->x[p.first], beam_->x[p.last]};
                               })},
            {"places", places_of_load()}};
  }

  /// Two where every load is straight.
  [[nodiscard]] int places_of_load() const {
    constexpr int enough_for_curves = 13;
    for (const load& l : what_.steps)
      for (const distributed_load& d : l.distributed)
        if (d.polynomial.size() > 2) return enough_for_curves;
    return 2;
  }

  /// The force per length at these places, piece after piece.
  [[nodiscard]] json spread_load(const beam_lines& lines) const {
    json q = json::array();
    const int places = places_of_load();
    for (const load_piece& p : shown_.loaded) {
      const double from = beam_->x[p.first];
      const double length = beam_->x[p.last] - from;
      for (int i = 0; i < places; ++i) {
        const double x = from + length * i / (places - 1);
        const auto next = std::upper_bound(beam_->x.begin() + p.first + 1, beam_->x.begin() + p.last, x);
        const element_line line = lines.at(static_cast<int>(next - beam_->x.begin()) - 1);
        q.push_back(polynomial_at(line.load, (x - line.left) / line.h));
      }
    }
    return q;
  }

  /// A quantity just left and just right of each station, and its least and largest value anywhere.
  [[nodiscard]] json section_forces(const element_results& results, std::size_t name,
                                    std::vector<double> element_line::*along, const beam_lines& lines,
                                    const value_range& range) const {
    const auto at = [&](int element, int end) {
      return element < 0 || element >= beam_->elements() ? json(nullptr)
                                                         : json(results.at(element, name)[end]);
    };
    const auto inside = [&](const station& s) { return polynomial_at(lines.at(s.node).*along, s.share); };
    const auto values = [&](int before, int end) {
      return list_of(shown_.stations, [&](const station& s) {
        return s.share == 0.0 ? at(s.node - before, end) : json(inside(s));
      });
    };
    return {{"left", values(1, 1)},
            {"right", values(0, 0)},
            {"least", extreme_json(range.least)},
            {"most", extreme_json(range.most)}};
  }

  /// A structure from elsewhere, its nodes numbered as they are shown, from 0: "names" and places of the
  /// nodes, "edges" between them, by their numbers, two by two; the "axes" that displacements have, the
  /// "unit" these are given in, and the largest of them, "reach"; "still": nodes without a dof; the "views"
  /// there are, and which "view" shows most.
  [[nodiscard]] json mesh_geometry() const {
    const placed_nodes& places = mesh_->places;
    const auto along = [&](int axis) {
      return list_of(shown_.nodes, [&](int node) { return places.nodes[node].at[axis]; });
    };
    json still = json::array();
    for (const int node : shown_.nodes)
      if (of_node_[node] == dofs_of_node{}) still.push_back(number_[node]);
    json edges = json::array();
    for (const int i : shown_.edges) {
      edges.push_back(number_[places.edges[i].from]);
      edges.push_back(number_[places.edges[i].to]);
    }
    return {
        {"kind", "mesh"},
        {"all_nodes", places.nodes.size()},
        {"all_edges", places.edges.size()},
        {"names", list_of(shown_.nodes, [&](int node) { return places.nodes[node].name; })},
        {"x", along(0)},
        {"y", along(1)},
        {"z", along(2)},
        {"edges", std::move(edges)},
        {"axes", axes_},
        {"unit", unit()},
        {"reach", shown_.reach},
        {"still", std::move(still)},
        {"views", list_of(all_views,
                          [](const structure_view& v) -> json {
                            return {{"name", v.name}, {"words", v.words}, {"right", v.right}, {"up", v.up}};
                          })},
        {"view", fitting_view(places)}};
  }

  /// The displacements of all nodes along the axes, as whole numbers of units.
  [[nodiscard]] json mesh_displacements(const frame& f) const {
    json u = json::array();
    for (const int node : shown_.nodes) {
      const in_space at = reading_at(of_node_[node].along, f);
      for (const int axis : axes_) u.push_back(std::lround(at[axis] / unit()));
    }
    return u;
  }

  /// The largest loads of those that can be drawn: [node, direction, dof, value, label].
  [[nodiscard]] json mesh_points(const load& l) const {
    std::vector<point_load> drawn;
    std::copy_if(l.points.begin(), l.points.end(), std::back_inserter(drawn),
                 [this](const point_load& p) { return node_of(p.node) >= 0 && p.value != 0.0; });
    return list_of(largest_loads(std::move(drawn)), [this](const point_load& p) -> json {
      return {node_of(p.node), mesh_->places.dofs[p.node].direction, p.node, p.value,
              mesh_->label_of(p.node)};
    });
  }

  /// Add "at" which node a dof is and in which "direction", 1 to 6; null and 0 where that is not shown.
  void add_place(int dof, json& entry) const {
    if (mesh_ == nullptr) return;
    const int node = node_of(dof);
    entry["at"] = node < 0 ? json(nullptr) : json(node);
    entry["direction"] = node < 0 ? 0 : mesh_->places.dofs[dof].direction;
  }

  /// The node of a dof on the page; -1 where it is not there.
  [[nodiscard]] int node_of(int dof) const {
    const int node = mesh_->places.dofs[dof].node;
    return node < 0 ? -1 : number_[node];
  }
  [[nodiscard]] double unit() const {
    constexpr double units = 1e5;  // in the largest displacement: a tenth of a pixel is some hundred of them
    return shown_.reach > 0.0 ? shown_.reach / units : 1.0;
  }

  [[nodiscard]] json supports() const {
    const auto names = dof_names(what_.geometry);
    std::map<int, json> at;
    for (const support& s : what_.supports) {
      if (!shown_.has_support_at(s.node)) continue;
      const place where = place_of_node(what_.geometry, s.node);
      json& entry = at[s.node];
      if (entry.is_null())
        entry = {{"node", named(what_, s.node)}, {"x", where.x}, {"y", where.y}, {"dofs", json::array()}};
      entry["dofs"].push_back({names[s.dof], s.fixed ? json(nullptr) : json(s.spring)});
    }
    return list_of(at, [this](const auto& of_node) {
      json entry = of_node.second;
      add_place(of_node.first, entry);
      return entry;
    });
  }

  [[nodiscard]] json pair(int i) const {
    const contact_pair& at = what_.pairs[i];
    const place where = place_of_node(what_.geometry, at.node);
    json entry = {{"pair", i + 1},
                  {"node", named(what_, at.node)},
                  {"x", where.x},
                  {"y", where.y},
                  {"side", at.surface},
                  {"face", at.face},
                  {"stiffness", at.stiffness}};
    add_place(at.node, entry);
    return entry;
  }

  /// The events of an increment: [pair, node, side, 1 for make], numbers from 1.
  [[nodiscard]] json events(const std::vector<event>& all) const {
    return list_of(std::span(all).first(std::min(all.size(), most_events)), [this](const event& e) -> json {
      const contact_pair& at = what_.pairs[e.pair];
      return {e.pair + 1, named(what_, at.node), at.surface, e.what == change::make ? 1 : 0};
    });
  }

  [[nodiscard]] json increment_of(const increment_record& i) const {
    return {{"step", i.step},
            {"number", i.number},
            {"s", i.s},
            {"fraction", i.fraction},
            {"snap", i.snaps},
            {"load", loads_.words_at(i.step, i.fraction, load_words_width)},
            {"events", events(i.events)},
            {"all_events", i.events.size()}};
  }

  /// The largest of them: [x, y, dof, value, node], nodes from 1.
  [[nodiscard]] json point_loads(const load& l) const {
    return list_of(largest_loads(l.points), [this](const point_load& at) -> json {
      const place where = place_of_node(what_.geometry, at.node);
      return {where.x, where.y, at.dof, at.value, at.node + 1};
    });
  }

  /// Deflection, slope, moment and shear at stations, and force per length for arrows.
  void add_beam_shape(const load& l, const frame& f, const std::vector<value_range>& ranges,
                      json& out) const {
    const element_results results = elements_in(what_, l, f);
    const station_reader at(*beam_, l, f.displacement, results.values);
    out["w"] = list_of(shown_.stations, [&](const station& s) { return at.w(s); });
    out["slope"] = list_of(shown_.stations, [&](const station& s) { return at.slope(s); });
    for (std::size_t name = 0; name < 2; ++name) {
      const auto range = std::ranges::find(ranges, results.names[name], &value_range::name);
      const auto along = results.names[name] == "moment" ? &element_line::moment : &element_line::shear;
      out[std::string(results.names[name])] = section_forces(results, name, along, at.lines(), *range);
    }
    out["q"] = shown_.loaded.empty() ? json(nullptr) : spread_load(at.lines());
  }

  /// At the crossings of the grid lines shown, row by row: deflections and, for colours, moments and, where
  /// there is a bed, its pressure on the plate.
  void add_plate_shape(const load& l, const frame& f, json& out) const {
    std::vector<int> crossings;
    for (const int j : shown_.rows)
      for (const int i : shown_.columns) crossings.push_back(plate_->node_at(i, j));
    out["w"] = list_of(crossings, [&](int node) { return deflection_of(what_, f, node); });
    const element_results results = elements_in(what_, l, f);
    for (std::size_t name = 0; name < results.names.size(); ++name) {
      const std::vector<double> means = means_at_nodes(*plate_, results, name);
      out[std::string(results.names[name])] =
          list_of(crossings, [&](int node) { return for_colour(means[node]); });
    }
    if (what_.beds.empty()) return;
    const std::vector<double> pressure = bed_pressure(what_, f);
    out["pressure"] = list_of(crossings, [&](int node) { return for_colour(pressure[node]); });
  }

  void add_pairs(const frame& f, json& out) const {
    std::string looks;
    for (const int i : shown_.pairs) looks += "ocf"[static_cast<int>(reading_of(what_, f, i).look)];
    const pair_counts n = count_pairs(what_, f);
    out["looks"] = looks;
    out["closed"] = list_of(shown_.pairs, [&](int i) { return f.closed(i) ? 1 : 0; });
    out["at_pairs"] = list_of(shown_.pairs, [&](int i) { return reading_of(what_, f, i).w; });
    out["forces"] = list_of(shown_.pairs, [&](int i) { return reading_of(what_, f, i).force; });
    out["counts"] = {n.open, n.closed, n.at_face};
  }

  /// The force on the structure by each support drawn; null where it holds no deflection.
  [[nodiscard]] json forces_of_supports(const load& l, const frame& f) const {
    const std::vector<double> all = reactions_in(what_, l, f);
    std::map<int, json> at;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const support& s = what_.supports[i];
      if (!shown_.has_support_at(s.node)) continue;
      json& force = at[s.node];
      if (s.dof == 0) force = all[i] + (force.is_null() ? 0.0 : force.get<double>());
    }
    return list_of(at, [](const auto& of_node) { return of_node.second; });
  }

  /// The largest deflection: its node, or its place where that is inside an element.
  [[nodiscard]] json largest_json(const std::vector<value_range>& ranges) const {
    if (ranges.empty()) return {{"w", 0.0}, {"node", named(what_, shown_.watched)}};
    const placed_value& v = ranges.front().largest();
    if (v.node < 0) return {{"w", v.value}, {"node", nullptr}, {"x", v.x}};
    return {{"w", v.value}, {"node", named(what_, v.node)}};
  }

  [[nodiscard]] json frame_of(const frame& f) const {
    const load l = loads_.at(f.step, f.fraction);
    const std::vector<value_range> ranges =
        ranges_of(what_.geometry, l, f.displacement, shown_.deflecting, elements_in(what_, l, f).values);
    json out = {{"at", f.at},
                {"step", f.step},
                {"number", f.number},
                {"fraction", f.fraction},
                {"s", f.s},
                {"snap", f.snaps},
                {"end", f.step_end},
                {"from_fallback", f.from_fallback},
                {"exact", f.from_exact_path},
                {"load", f.step == 0 ? "none" : loads_.words_at(f.step, f.fraction, load_words_width)},
                {"force", loads_.force_at(f.step, f.fraction)},
                {"largest", largest_json(ranges)},
                {"watched", deflection_of(what_, f, shown_.watched)},
                {"events", events(f.events)},
                {"all_events", f.events.size()}};
    if (beam_ != nullptr) add_beam_shape(l, f, ranges, out);
    if (plate_ != nullptr) add_plate_shape(l, f, out);
    if (beam_ != nullptr || plate_ != nullptr) {
      out["points"] = point_loads(l);
      out["reactions"] = forces_of_supports(l, f);
    }
    add_pairs(f, out);
    if (mesh_ != nullptr) out.update({{"u", mesh_displacements(f)}, {"points", mesh_points(l)}});
    return out;
  }

  const finished_run& run_;
  const problem& what_;
  load_path loads_;
  shown_parts shown_;
  const beam* beam_ = std::get_if<beam>(&what_.geometry.kind);
  const plate* plate_ = std::get_if<plate>(&what_.geometry.kind);
  const assembled* mesh_ = nullptr;    // whose nodes have places
  std::vector<dofs_of_node> of_node_;  // of the mesh
  std::vector<int> axes_;
  json input_, ends_, envelope_;  // tables
  std::vector<int> number_;       // of a node on the page; -1: it is not there
};

/// As text of an HTML script element, where only "<" can begin anything: whatever its strings hold, none of
/// it is markup.
std::string script_text(const json& data) {
  std::string safe;
  for (const char c : json_text(data)) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

/// The one section of the parallel edition, whose file is a page of its own.
std::string_view edition_section() {
  constexpr std::string_view last = "</section>\n";
  const std::size_t from = parallel_edition_html.find("<section");
  return parallel_edition_html.substr(from, parallel_edition_html.rfind(last) + last.size() - from);
}

}  // namespace

json page_data(const finished_run& r) {
  return page_writer(r).whole();
}

/// The template's places are filled from its beginning to its end, so what is filled in is not looked at.
std::string run_page(const finished_run& r) {
  const std::pair<std::string_view, std::string> fillings[] = {
      {"{{title}}", markup_text(title_of(r))},   {"{{style}}", std::string(report_css)},
      {"{{heading}}", markup_text(title_of(r))}, {"{{edition}}", std::string(edition_section())},
      {"{{data}}", script_text(page_data(r))},   {"{{script}}", std::string(report_js)}};
  std::string_view rest = report_html;
  std::string page;
  for (const auto& [place, text] : fillings) {
    const std::size_t at = rest.find(place);
    if (at == std::string_view::npos) throw std::logic_error("report.html has no " + std::string(place));
    page.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + place.size());
  }
  return page += rest;
}

}  // namespace contct::write
