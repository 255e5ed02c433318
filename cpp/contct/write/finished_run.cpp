#include "contct/write/finished_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "contct/path/solve_problem.hpp"

namespace contct::write {
namespace {

/// How much there is to write: a list of scattered elements counts by its length.
std::size_t parts_of(const load& l) {
  std::size_t parts = l.points.size() + l.settlements.size();
  for (const distributed_load& d : l.distributed)
    parts += d.elements.empty() || is_run(d.elements) ? 1 : d.elements.size();
  return parts;
}

/// A load in words, with its one number apart.
struct load_words {
  std::string before;
  double value;
  std::string after{};
};

/// Of settlements alone: the only one, or the largest.
load_words settlement_words(const model& m, const std::vector<prescribed_displacement>& all) {
  const auto size = [](const prescribed_displacement& g) { return std::abs(g.value); };
  const prescribed_displacement& g = *std::ranges::max_element(all, {}, size);
  if (all.size() > 1) return {"settle ", g.value};
  const std::string name =
      std::holds_alternative<assembled>(m.kind) ? "" : fmt::format("{} ", dof_names(m)[g.dof]);
  return {"settle " + name, g.value, " at " + place_words(m, g.node)};
}

load_words words_for(const model& m, const load& l, const resultant& r) {
  const bool of_matrix = std::holds_alternative<assembled>(m.kind);
  if (!l.settlements.empty() && l.points.empty() && l.distributed.empty())
    return settlement_words(m, l.settlements);
  if (!l.settlements.empty()) return {of_matrix ? "sum " : "force ", r.force};
  if (l.points.size() == 1 && l.distributed.empty()) {
    const point_load& p = l.points[0];
    return {of_matrix ? "" : fmt::format("{} ", dof_names(m)[p.dof]), p.value,
            " at " + place_words(m, p.node)};
  }
  if (l.points.empty() && l.distributed.size() == 1 && l.distributed[0].polynomial.size() == 1)
    return {"uniform ", l.distributed[0].polynomial[0]};
  return {of_matrix ? "sum " : "force ", r.force};
}

/// x, or 0 where it is nothing but the rounding of numbers of this size.
double without_rounding(double x, double size) {
  return std::abs(x) <= 32 * std::numeric_limits<double>::epsilon() * size ? 0.0 : x;
}

double between(double a, double b, double share) {
  return without_rounding(a + share * (b - a), std::max(std::abs(a), std::abs(b)));
}

void insert(std::vector<int>& sorted, int number) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), number);
  if (at == sorted.end() || *at != number) sorted.insert(at, number);
}

void choose_nodes(const beam& b, const finished_run& r, shown_parts& shown) {
  const auto frames = r.kept.frames().size();
  shown.nodes = evenly(b.nodes(), std::max<std::size_t>(100, most_places / frames));
  if (std::ssize(shown.nodes) == b.nodes()) return;
  insert(shown.nodes, shown.watched);
  constexpr std::size_t most_more = 60;
  const std::size_t most = shown.nodes.size() + most_more;
  for (const support& s : r.what.supports) {
    if (s.fixed && shown.nodes.size() < most) insert(shown.nodes, s.node);
  }
  shown.omissions.push_back(fmt::format(
      "Shapes, moments and shears are drawn at {} of {} nodes, evenly chosen, with the ends, fixed "
      "supports and the node that deflects most. The largest values are those of all nodes.",
      shown.nodes.size(), b.nodes()));
}

/// The nodes shown and, where all of them are and few, places inside elements that carry a distributed load:
/// between others the cubics of the ends' deflections and slopes, and straight moments, are exact.
void choose_stations(const beam& b, const finished_run& r, shown_parts& shown) {
  constexpr std::size_t most_inside = 8;
  constexpr std::size_t enough = 120;
  shown.loaded = load_pieces(r.what, b);
  const std::size_t most = most_places / r.kept.frames().size();
  const std::size_t elements = b.elements();
  const bool all = std::ssize(shown.nodes) == b.nodes();
  const std::size_t parts =
      all ? std::min({most_inside, (enough + elements - 1) / elements, most / elements}) : 1;
  auto piece = shown.loaded.begin();
  for (const int node : shown.nodes) {
    shown.stations.push_back({node, 0.0});
    while (piece != shown.loaded.end() && piece->last <= node) ++piece;
    if (piece == shown.loaded.end() || node < piece->first) continue;
    for (std::size_t k = 1; k < parts; ++k)
      shown.stations.push_back({node, static_cast<double>(k) / static_cast<double>(parts)});
  }
  const std::size_t pieces = shown.loaded.size();
  if (pieces <= most_load_pieces) return;
  std::vector<load_piece> some;
  for (const int i : evenly(pieces, most_load_pieces)) some.push_back(shown.loaded[i]);
  shown.loaded = std::move(some);
  shown.omissions.push_back(
      fmt::format("Distributed loads are drawn on {} of the {} pieces between their jumps, evenly chosen.",
                  shown.loaded.size(), pieces));
}

/// As many lines in either direction as the grid points that all frames may have together allow.
void choose_lines(const plate& p, const finished_run& r, shown_parts& shown) {
  const double points = static_cast<double>(most_grid_points) / static_cast<double>(r.kept.frames().size());
  const double all = static_cast<double>(p.columns()) * p.rows();
  const double share = std::min(1.0, std::sqrt(points / all));
  const auto some = [&](int lines) { return evenly(lines, std::max(4, static_cast<int>(share * lines))); };
  shown.columns = some(p.columns());
  shown.rows = some(p.rows());
  if (std::ssize(shown.columns) == p.columns() && std::ssize(shown.rows) == p.rows()) return;
  insert(shown.columns, shown.watched % p.columns());
  insert(shown.rows, shown.watched / p.columns());
  shown.omissions.push_back(
      fmt::format("Contours go through {} of {} nodes: {} of {} grid lines by {} of {}, evenly chosen, with "
                  "those of the node that deflects most. The largest values are those of all nodes.",
                  shown.columns.size() * shown.rows.size(), p.nodes(), shown.columns.size(), p.columns(),
                  shown.rows.size(), p.rows()));
}

/// Edges in the order in which they are drawn until there are too many: those of the fewest elements first,
/// which are the outer ones of a solid, and among equals so that any beginning of them is spread over all.
std::vector<int> edges_by_weight(const placed_nodes& places) {
  constexpr double golden = 0.6180339887498949;
  const auto spread = [](int i) { return i * golden - std::floor(i * golden); };
  std::vector<int> order(places.edges.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int i) { return std::pair(places.edges[i].elements, spread(i)); });
  return order;
}

/// The nodes of what is marked: pairs, supports, and the dof that is watched.
std::set<int> marked_nodes(const finished_run& r, const placed_nodes& places, const shown_parts& shown) {
  std::set<int> marked = {places.dofs[shown.watched].node};
  for (const int i : shown.pairs) marked.insert(places.dofs[r.what.pairs[i].node].node);
  for (const int dof : shown.supports) marked.insert(places.dofs[dof].node);
  marked.erase(-1);  // those of dofs whose place is not known
  return marked;
}

/// As many edges as the numbers of all frames together allow; where there are none, nodes.
void choose_mesh(const placed_nodes& places, const finished_run& r, shown_parts& shown) {
  std::set<int> chosen = marked_nodes(r, places, shown);
  const std::size_t numbers = r.kept.frames().size() * std::max<std::size_t>(1, axes_of(places).size());
  const std::size_t most = std::max<std::size_t>(300, most_mesh_numbers / numbers);
  for (const int i : edges_by_weight(places)) {
    if (shown.edges.size() == most_edges || chosen.size() + 2 > most) break;
    chosen.insert({places.edges[i].from, places.edges[i].to});
    shown.edges.push_back(i);
  }
  std::sort(shown.edges.begin(), shown.edges.end());
  // Nodes without an edge are points of their own.
  if (shown.edges.size() == places.edges.size())
    for (const int node : evenly(places.nodes.size(), most)) chosen.insert(node);
  shown.nodes.assign(chosen.begin(), chosen.end());
  const std::vector<dofs_of_node> of_node = dofs_of_nodes(places);
  for (const frame& f : r.kept.frames()) {
    for (const int node : shown.nodes) {
      const auto [x, y, z] = reading_at(of_node[node].along, f);
      shown.reach = std::max(shown.reach, std::hypot(x, y, z));
    }
  }
}

void add_mesh_omissions(const placed_nodes& places, shown_parts& shown) {
  if (shown.edges.size() < places.edges.size() || shown.nodes.size() < places.nodes.size())
    shown.omissions.push_back(fmt::format(
        "{} of {} edges and {} of {} nodes are drawn: edges of the fewest elements first, which are the "
        "outer ones of a solid, and evenly chosen among equals. The largest displacement is that of all.",
        shown.edges.size(), places.edges.size(), shown.nodes.size(), places.nodes.size()));
}

void choose_pairs(const finished_run& r, shown_parts& shown) {
  const std::size_t all = r.what.pairs.size();
  const bool on_a_beam = std::holds_alternative<beam>(r.what.geometry.kind);
  const std::size_t most = std::clamp<std::size_t>(most_pair_states / r.kept.frames().size(), 200,
                                                   on_a_beam ? most_pairs_of_a_beam : most_pairs);
  shown.pairs = evenly(all, most);
  if (shown.pairs.size() == all) return;
  shown.omissions.push_back(
      fmt::format("{} of {} pairs are drawn and listed, evenly chosen. The numbers in contact, separated and "
                  "at their faces count all pairs, and events are those of all.",
                  shown.pairs.size(), all));
}

/// The nodes with supports that are drawn.
void choose_supports(const finished_run& r, shown_parts& shown) {
  std::set<int> nodes;
  for (const support& s : r.what.supports) nodes.insert(s.node);
  const std::vector<int> held(nodes.begin(), nodes.end());
  for (const int i : evenly(held.size(), most_supports)) shown.supports.push_back(held[i]);
  if (shown.supports.size() == held.size()) return;
  shown.omissions.push_back(fmt::format("Supports are drawn at {} of {} {}s that have them, evenly chosen.",
                                        shown.supports.size(), held.size(), node_name(r.what.geometry)));
}

void add_count_omissions(const finished_run& r, shown_parts& shown) {
  const frame_keeper& kept = r.kept;
  if (std::ssize(kept.frames()) < kept.increments() + 1) {
    shown.omissions.push_back(
        fmt::format("The path has {} increments; the slider stops at {} states: the start, one in {} of the "
                    "increments within a step, and ends of steps.",
                    kept.increments(), kept.frames().size(), kept.stride()));
  }
  const auto loads_of_step = [](const load& l) { return l.points.size(); };
  const auto loads = std::ranges::max(r.what.steps, {}, loads_of_step).points.size();
  if (loads > most_loads)
    shown.omissions.push_back(
        fmt::format("Of up to {} point loads the {} largest are drawn.", loads, most_loads));
  const auto events =
      r.record.increments.empty() ? 0 : std::ranges::max(r.record.increments, {}, [](const auto& i) {
                                          return i.events.size();
                                        }).events.size();
  const auto first = [&](const char* what, std::size_t here, std::size_t all) {
    if (here < all)
      shown.omissions.push_back(fmt::format("Of {} {} the first {} are listed.", all, what, here));
  };
  first("events of an increment", std::min(events, most_events), events);
  if (!r.record.calls.empty())
    first("pairs' s in each call", r.record.calls.front().ss.size(), r.what.pairs.size());
  first("increments", r.record.increments.size(), r.record.all_increments);
  first("calls", r.record.calls.size(), r.record.all_calls);
  first("bytes of unit 26", r.record.log.size(), r.record.all_log);
}

}  // namespace

bool is_run(const std::vector<int>& elements) {
  return elements.back() - elements.front() + 1 == static_cast<int>(elements.size()) &&
         std::is_sorted(elements.begin(), elements.end());
}

load_path::load_path(const problem& p) : problem_(p), totals_{resultant_of(p.geometry, {})}, parts_(1) {
  for (const load& l : p.steps) {
    totals_.push_back(resultant_of(p.geometry, l));
    parts_.push_back(parts_of(l));
  }
}

load load_path::at(int step, double fraction) const {
  if (step == 0) return {};
  return mix(step > 1 ? problem_.steps[step - 2] : load{}, problem_.steps[step - 1], fraction);
}

resultant load_path::resultant_at(int step, double fraction) const {
  const resultant& a = totals_[step - 1];
  const resultant& b = totals_[step];
  resultant r{between(a.force, b.force, fraction), a.moments};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    r.moments[i] = between(a.moments[i], b.moments[i], fraction);
  return r;
}

bool load_path::has_many_parts(int step) const {
  constexpr std::size_t most = 32;
  return std::max(parts_[step - 1], parts_[step]) > most;
}

std::string load_path::words_at(int step, double fraction, int width) const {
  const auto words_of = [&](double share) {
    const load l = has_many_parts(step) ? load{} : at(step, share);
    return words_for(problem_.geometry, l, resultant_at(step, share));
  };
  load_words w = words_of(fraction);
  w.value = without_rounding(w.value, std::max(std::abs(words_of(0.0).value), std::abs(words_of(1.0).value)));
  const auto fits = [width](const std::string& text) { return static_cast<int>(text.size()) <= width; };
  const std::string number = fmt::format("{:.6g}", w.value);
  for (std::string text : {w.before + number + w.after, w.before + number, number})
    if (fits(text)) return text;
  return "";
}

double deflection_of(const problem& p, std::span<const double> u, int node) {
  return u[static_cast<std::size_t>(node) * dofs_per_node(p.geometry)];
}

pair_reading reading_of(const contact_pair& p, double w, bool closed) {
  return {w, gap_of(p, w, closed), force_of(p, w, closed), look_of(p, w, closed)};
}

pair_reading reading_of(const problem& p, const frame& f, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  pair_reading r = reading_of(at, deflection_of(p, f, at.node), f.closed(pair));
  if (!f.pair_forces.empty()) r.force = f.pair_forces[pair];
  return r;
}

std::vector<double> reactions_in(const problem& p, const load& l, const frame& f) {
  return f.numbers ? f.numbers->reactions : reactions(p, l, f.displacement, f.isep);
}

element_results elements_in(const problem& p, const load& l, const frame& f) {
  element_results r = results_in_elements(p.geometry, l, f.displacement);
  if (f.numbers) r.values = f.numbers->element_values;
  return r;
}

void extreme::take(int other_at, double other) {
  if (std::abs(other) > std::abs(value)) *this = {other_at, other};
}

std::vector<int> deflecting_nodes(const problem& p) {
  std::vector<char> is_length(nodes(p.geometry), 1);
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a != nullptr && (a->places.known() || !p.pairs.empty())) {
    for (std::size_t dof = 0; dof < is_length.size(); ++dof)
      is_length[dof] = a->places.known() && a->places.dofs[dof].is_length() ? 1 : 0;
    for (const contact_pair& pair : p.pairs) is_length[pair.node] = 1;
  }
  std::vector<int> list;
  for (int node = 0; node < nodes(p.geometry); ++node)
    if (is_length[node] != 0) list.push_back(node);
  return list;
}

extreme largest_deflection(const problem& p, const frame& f, std::span<const int> among) {
  extreme most{among.empty() ? 0 : among.front()};
  for (const int node : among) most.take(node, deflection_of(p, f, node));
  return most;
}

pair_counts count_pairs(const problem& p, const frame& f) {
  pair_counts n;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) ++n.of(reading_of(p, f, i).look);
  return n;
}

std::vector<double> bed_pressure(const problem& p, const frame& f) {
  std::vector<double> at(nodes(p.geometry));
  for (const bed& b : p.beds) {
    for (std::size_t i = 0; i < b.share.size(); ++i) {
      const std::size_t pair = b.first_pair + i;
      if (b.share[i] > 0.0) at[p.pairs[pair].node] += reading_of(p, f, pair).force / b.share[i];
    }
  }
  return at;
}

std::string place_name(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? a->label_of(node) : std::to_string(node + 1);
}

place place_of_node(const model& m, int node) {
  if (const auto* b = std::get_if<beam>(&m.kind)) return {b->x[node], 0.0};
  const auto* p = std::get_if<plate>(&m.kind);
  if (p == nullptr) return {static_cast<double>(node), 0.0};
  return {p->x[node % p->columns()], p->y[node / p->columns()]};
}

std::vector<dofs_of_node> dofs_of_nodes(const placed_nodes& places) {
  std::vector<dofs_of_node> list(places.nodes.size());
  for (std::size_t dof = 0; dof < places.dofs.size(); ++dof) {
    const placed_dof& at = places.dofs[dof];
    if (at.node < 0) continue;
    dofs_of_node& of = list[at.node];
    const int axis = (at.direction - 1) % 3;
    (at.is_length() ? of.along : of.about)[axis] = static_cast<int>(dof);
  }
  return list;
}

std::vector<int> axes_of(const placed_nodes& places) {
  std::array<bool, 3> has{};
  for (const placed_dof& d : places.dofs)
    if (d.is_length()) has[d.direction - 1] = true;
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (has[axis]) axes.push_back(axis);
  return axes;
}

in_space reading_at(const std::array<int, 3>& dofs, const frame& f) {
  in_space u{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (dofs[axis] >= 0) u[axis] = f.displacement[dofs[axis]];
  return u;
}

int fitting_view(const placed_nodes& places) {
  const std::vector<int> axes = axes_of(places);
  for (const auto& [normal, view] : {std::pair(2, 0), {1, 1}, {0, 2}}) {
    const double first = places.nodes.front().at[normal];
    const bool flat = std::ranges::all_of(
        places.nodes, [first, axis = normal](const placed_node& n) { return n.at[axis] == first; });
    if (flat && std::ranges::find(axes, normal) == axes.end()) return view;
  }
  return static_cast<int>(all_views.size()) - 1;
}

void run_record::called(const answered_call& c) {
  ++all_calls;
  all_log += c.text.size();
  // Whole calls only: a text is never cut in the middle of an event.
  if (log.size() + c.text.size() <= most_log && log.size() + c.text.size() == all_log) log += c.text;
  answers_ = calls.size() < most_calls;
  if (!answers_) return;
  const auto first = c.c.ss.first(std::min(most_ss, c.c.ss.size()));
  calls.push_back({0, 0, c.c.smin, {first.begin(), first.end()}, {}});
  if (compared_ != nullptr) calls.back().followers = compared_->last_answers();
}

void run_record::incremented(const increment& i) {
  if (std::exchange(answers_, false)) {
    calls.back().step = i.step;
    calls.back().number = i.number;
  }
  if (all_increments++ < most_increments) increments.emplace_back(i);
}

std::string title_of(const problem& p, const std::string& file) {
  const bool named = p.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(p.title);
  return file == "-" ? "A problem from standard input" : std::filesystem::path(file).filename().string();
}

std::vector<int> evenly(std::size_t all, std::size_t count) {
  std::vector<int> chosen;
  count = std::min(all, count);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? 0 : static_cast<int>(i * (all - 1) / (count - 1)));
  return chosen;
}

std::vector<point_load> largest_loads(std::vector<point_load> loads) {
  std::ranges::stable_sort(loads, std::greater{}, [](const point_load& p) { return std::abs(p.value); });
  if (loads.size() > most_loads) loads.resize(most_loads);
  return loads;
}

double station_reader::x(const station& s) const {
  return s.share == 0.0 ? beam_.x[s.node] : beam_.x[s.node] + s.share * beam_.length_of(s.node);
}

double station_reader::w(const station& s) const {
  return s.share == 0.0 ? u_[std::size_t{2} * s.node] : polynomial_at(lines_.at(s.node).w, s.share);
}

double station_reader::slope(const station& s) const {
  return s.share == 0.0 ? u_[std::size_t{2} * s.node + 1] : polynomial_at(lines_.at(s.node).slope, s.share);
}

std::vector<load_piece> load_pieces(const problem& p, const beam& b) {
  using polynomials = std::vector<std::vector<double>>;  // of each step; empty: none
  std::vector<polynomials> of_element(b.elements(), polynomials(p.steps.size()));
  for (std::size_t step = 0; step < p.steps.size(); ++step)
    for_each_loaded_element(p.steps[step], b.elements(), [&](int e, std::span<const double> part) {
      add_polynomial(of_element[e][step], part, 1.0);
    });
  const polynomials nothing(p.steps.size());
  std::vector<load_piece> pieces;
  for (int e = 0; e < b.elements(); ++e) {
    if (of_element[e] == nothing) continue;
    const bool goes_on = !pieces.empty() && pieces.back().last == e && of_element[e - 1] == of_element[e];
    goes_on ? void(++pieces.back().last) : pieces.push_back({e, e + 1});
  }
  return pieces;
}

bool shown_parts::has_support_at(int node) const {
  return std::binary_search(supports.begin(), supports.end(), node);
}

shown_parts choose_parts(const finished_run& r) {
  shown_parts shown;
  shown.deflecting = deflecting_nodes(r.what);
  extreme most{shown.deflecting.empty() ? 0 : shown.deflecting.front()};
  for (const frame& f : r.kept.frames()) {
    const extreme here = largest_deflection(r.what, f, shown.deflecting);
    most.take(here.at, here.value);
  }
  shown.watched = most.at;
  if (const auto* b = std::get_if<beam>(&r.what.geometry.kind)) {
    choose_nodes(*b, r, shown);
    choose_stations(*b, r, shown);
  }
  if (const auto* p = std::get_if<plate>(&r.what.geometry.kind)) choose_lines(*p, r, shown);
  choose_pairs(r, shown);
  choose_supports(r, shown);
  if (const auto* a = std::get_if<assembled>(&r.what.geometry.kind)) {
    if (a->places.known()) {
      choose_mesh(a->places, r, shown);
      add_mesh_omissions(a->places, shown);
    }
    shown.omissions.insert(shown.omissions.end(), a->places.said.begin(), a->places.said.end());
  }
  add_count_omissions(r, shown);
  return shown;
}

}  // namespace contct::write
