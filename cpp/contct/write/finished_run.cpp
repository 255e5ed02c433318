#include "contct/write/finished_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "contct/write/frame_numbers.hpp"

namespace contct::write {
namespace {

int watched_node(const finished_run& r, const std::vector<int>& among) {
  extreme most{among.empty() ? 0 : among.front()};
  for (const frame& f : r.kept.frames()) {
    const extreme here = largest_deflection(r.what, f, among);
    most.take(here.at, here.value);
  }
  return most.at;
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
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const int of_a = places.edges[a].elements;
    const int of_b = places.edges[b].elements;
    return of_a != of_b ? of_a < of_b : spread(a) < spread(b);
  });
  return order;
}

/// The nodes of what is marked: pairs, supports, and the dof that is watched.
std::vector<char> marked_nodes(const finished_run& r, const placed_nodes& places, const shown_parts& shown) {
  std::vector<char> marked(places.nodes.size(), 0);
  const auto mark = [&](int dof) {
    const int node = places.dofs[dof].node;
    if (node >= 0) marked[node] = 1;
  };
  mark(shown.watched);
  for (const int i : shown.pairs) mark(r.what.pairs[i].node);
  for (const int dof : shown.supports) mark(dof);
  return marked;
}

/// As many edges as the numbers of all frames together allow; where there are none, nodes.
void choose_mesh(const placed_nodes& places, const finished_run& r, shown_parts& shown) {
  std::vector<char> chosen = marked_nodes(r, places, shown);
  const std::size_t numbers = r.kept.frames().size() * std::max<std::size_t>(1, axes_of(places).size());
  const std::size_t most = std::max<std::size_t>(300, most_mesh_numbers / numbers);
  std::size_t count = std::count(chosen.begin(), chosen.end(), 1);
  const auto choose = [&](int node) {
    count += chosen[node] == 0 ? 1 : 0;
    chosen[node] = 1;
  };
  for (const int i : edges_by_weight(places)) {
    if (shown.edges.size() == most_edges || count + 2 > most) break;
    choose(places.edges[i].from);
    choose(places.edges[i].to);
    shown.edges.push_back(i);
  }
  std::sort(shown.edges.begin(), shown.edges.end());
  // Nodes without an edge are points of their own.
  const std::size_t all = places.nodes.size();
  if (shown.edges.size() == places.edges.size())
    for (const int node : evenly(all, most)) choose(node);
  for (std::size_t node = 0; node < all; ++node)
    if (chosen[node] != 0) shown.nodes.push_back(static_cast<int>(node));
  const std::vector<dofs_of_node> of_node = dofs_of_nodes(places);
  for (const frame& f : r.kept.frames()) {
    for (const int node : shown.nodes)
      shown.reach = std::max(shown.reach, length_of(reading_at(of_node[node].along, f)));
  }
}

void add_mesh_omissions(const placed_nodes& places, const finished_run& r, shown_parts& shown) {
  const auto is_long = [](const load& l) { return l.points.size() > most_loads; };
  if (std::any_of(r.what.steps.begin(), r.what.steps.end(), is_long))
    shown.omissions.push_back(
        fmt::format("Of loads at more dofs than {} the largest so many are drawn.", most_loads));
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
      fmt::format("{} of {} pairs are drawn and listed, evenly chosen. How many are open, closed or at their "
                  "faces is counted over all of them, and events are those of all.",
                  shown.pairs.size(), all));
}

/// The nodes with supports that are drawn.
void choose_supports(const finished_run& r, shown_parts& shown) {
  std::vector<int> held;
  for (const support& s : r.what.supports) held.push_back(s.node);
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
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
  const auto first = [&](const char* what, std::size_t here, std::size_t all) {
    if (here < all)
      shown.omissions.push_back(fmt::format("Of {} {} the first {} are listed.", all, what, here));
  };
  first("increments", r.record.increments.size(), r.record.all_increments);
  first("calls", r.record.calls.size(), r.record.all_calls);
  first("bytes of unit 26", r.record.log.size(), r.record.all_log);
}

}  // namespace

void run_record::called(const answered_call& c) {
  ++all_calls;
  all_log += c.text.size();
  // Whole calls only: a text is never cut in the middle of an event.
  if (log.size() + c.text.size() <= most_log && log.size() + c.text.size() == all_log) log += c.text;
  answers_ = calls.size() < most_calls;
  if (!answers_) return;
  call_record r;
  r.smin = c.c.smin;
  const auto first = c.c.ss.first(std::min(most_ss, c.c.ss.size()));
  r.ss.assign(first.begin(), first.end());
  if (compared_ != nullptr) r.followers = compared_->last_answers();
  calls.push_back(std::move(r));
}

void run_record::incremented(const increment& i) {
  if (answers_) {
    calls.back().step = i.step;
    calls.back().number = i.number;
  }
  answers_ = false;
  if (all_increments++ < most_increments) increments.emplace_back(i);
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char ch) { return ch == '\n' || ch == '\r'; }, ' ');
  return text;
}

std::string title_of(const finished_run& r) {
  const bool named = r.what.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(r.what.title);
  return r.file == "-" ? "A problem from standard input" : std::filesystem::path(r.file).filename().string();
}

std::vector<int> evenly(std::size_t all, std::size_t count) {
  std::vector<int> chosen;
  count = std::min(all, count);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? 0 : static_cast<int>(i * (all - 1) / (count - 1)));
  return chosen;
}

std::vector<point_load> largest_loads(std::vector<point_load> loads) {
  std::stable_sort(loads.begin(), loads.end(), [](const point_load& one, const point_load& other) {
    return std::abs(one.value) > std::abs(other.value);
  });
  if (loads.size() > most_loads) loads.resize(most_loads);
  return loads;
}

std::vector<double> sampled_load(const beam& b, const load& l) {
  std::vector<double> samples;
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
    samples.push_back(q);
  }
  return samples;
}

bool shown_parts::has_support_at(int node) const {
  return std::binary_search(supports.begin(), supports.end(), node);
}

shown_parts choose_parts(const finished_run& r) {
  shown_parts shown;
  shown.deflecting = deflecting_nodes(r.what);
  shown.watched = watched_node(r, shown.deflecting);
  if (const auto* b = std::get_if<beam>(&r.what.geometry.kind)) choose_nodes(*b, r, shown);
  if (const auto* p = std::get_if<plate>(&r.what.geometry.kind)) choose_lines(*p, r, shown);
  choose_pairs(r, shown);
  choose_supports(r, shown);
  if (const auto* a = std::get_if<assembled>(&r.what.geometry.kind)) {
    if (a->places.known()) {
      choose_mesh(a->places, r, shown);
      add_mesh_omissions(a->places, r, shown);
    }
    shown.omissions.insert(shown.omissions.end(), a->places.said.begin(), a->places.said.end());
  }
  add_count_omissions(r, shown);
  return shown;
}

}  // namespace contct::write
