#include "contct/results/step_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "contct/kernel/contct.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct {
namespace {

/// Of numbers that differ only by rounding, the first one counts as the largest.
constexpr double above_ties = 1 + 1e-9;

}  // namespace

bool has_no_mesh_error(const problem& p) {
  return std::holds_alternative<beam>(p.geometry.kind) && p.beds.empty();
}

std::size_t contacts_of(const problem& p) {
  return p.beds.empty() ? p.pairs.size() : p.beds.front().first_pair;
}

double deflection_of(const problem& p, std::span<const double> u, int node) {
  return u[static_cast<std::size_t>(node) * dofs_per_node(p.geometry)];
}

std::vector<int> deflecting_nodes(const problem& p) {
  std::vector<char> is_length(nodes(p.geometry), 1);
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a != nullptr && a->places.known()) {
    for (std::size_t dof = 0; dof < is_length.size(); ++dof)
      is_length[dof] = a->places.dofs[dof].is_length() ? 1 : 0;
    for (const contact_pair& pair : p.pairs)
      for (const int node : {pair.node, pair.other})
        if (node >= 0) is_length[node] = 1;
  }
  std::vector<int> list;
  for (int node = 0; node < nodes(p.geometry); ++node)
    if (is_length[node] != 0) list.push_back(node);
  return list;
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

std::vector<int> nodes_of_element(const model& m, int element) {
  const auto* const on_plate = std::get_if<plate>(&m.kind);
  if (on_plate == nullptr) return {element, element + 1};
  const auto corners = on_plate->corners_of(element);
  return {corners.begin(), corners.end()};
}

std::optional<std::size_t> step_results::hardest_pair() const {
  std::optional<std::size_t> hardest;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].force > (hardest ? above_ties * pairs[*hardest].force : 0.0)) hardest = i;
  return hardest;
}

bool is_turning(const problem& p, const support& s) {
  const auto* const a = std::get_if<assembled>(&p.geometry.kind);
  return s.dof != 0 || (a != nullptr && a->places.known() && a->places.dofs[s.node].direction > 3);
}

std::vector<std::size_t> step_results::hardest_supports() const {
  std::optional<std::size_t> up;  // the first with the largest force
  std::optional<std::size_t> down;
  for (std::size_t i = 0; i < reactions.size(); ++i) {
    if (is_turning(what, what.supports[i])) continue;
    const double tie = tie_of(std::abs(reactions[i]), 0.0);
    if (!up || reactions[i] > reactions[*up] + tie) up = i;
    if (!down || reactions[i] < reactions[*down] - tie) down = i;
  }
  if (!up) return {};
  std::vector<std::size_t> all = {*up, *down};
  if (-reactions[all[1]] > above_ties * reactions[all[0]]) std::swap(all[0], all[1]);
  const auto [most, other] = std::pair(reactions[all[0]], reactions[all[1]]);
  if (most * other >= 0.0 || std::abs(other) <= tie_of(0.0, std::abs(most))) all.pop_back();
  return all;
}

pair_reading reading_of(const pair_in<double>& p, double w, bool closed) {
  const pair_state look = std::abs(p.face - w) < constants<double>::epsgap ? pair_state::at_face
                          : closed                                         ? pair_state::closed
                                                                           : pair_state::open;
  return {w, gap_of(p, w, closed), force_of(p, w, closed), look, p.face};
}

step_results::step_results(const problem& p, const structure_state& s)
    : what(p), state(s), acting(load_at(p, s.step, s.fraction)) {
  end_numbers now = statics_of(p, acting, s.displacement, s.isep, s.numbers);
  elements = with_names(p.geometry, std::move(now.element_values));
  reactions = std::move(now.reactions);
  for (const pair_in<double>& c : pairs_under(p, acting))
    pairs.push_back(reading_of(c, c.seen_in(s.displacement), s.closed(pairs.size())));
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].force = now.pair_forces[i];
  for (const pair_in<double>& c : held_under(p, acting)) {
    const double w = c.seen_in(s.displacement);
    held.push_back(reading_of(c, w, !(depth_of(c, w) < 0.0)));
  }
}

const std::vector<value_range>& step_results::ranges() const {
  if (!ranges_)
    ranges_ = ranges_of(what.geometry, acting, state.displacement, deflecting_nodes(what), elements.values);
  return *ranges_;
}

const element_results& step_results::stresses() const {
  if (!stresses_) stresses_ = stresses_of(what.geometry, elements);
  return *stresses_;
}

std::optional<beam_lines> step_results::lines() const {
  const auto* const b = std::get_if<beam>(&what.geometry.kind);
  if (b == nullptr) return {};
  return beam_lines(*b, acting, state.displacement, elements.values);
}

std::optional<force_balance> balance_of(const step_results& r) {
  const problem& p = r.what;
  if (std::holds_alternative<assembled>(p.geometry.kind)) return {};
  std::vector<double> held;
  std::vector<double> pressed;
  for (std::size_t i = 0; i < r.reactions.size(); ++i)
    if (p.supports[i].dof == 0) held.push_back(r.reactions[i]);
  for (std::size_t i = 0; i < r.pairs.size(); ++i) pressed.push_back(-p.pairs[i].surface * r.pairs[i].force);
  auto held_by = r.held.begin();
  for (const bed& b : p.beds)
    for (const contact_pair& at : b.held) pressed.push_back(-at.surface * held_by++->force);
  const auto sum_of = [](const std::vector<double>& forces) {  // 0 if the sum is only rounding
    const double sum = std::accumulate(forces.begin(), forces.end(), 0.0);
    const auto add_size = [](double size, double x) { return size + std::abs(x); };
    const double size = std::accumulate(forces.begin(), forces.end(), 0.0, add_size);
    return std::abs(sum) <= tie_of(0.0, size) ? 0.0 : sum;
  };
  return force_balance{resultant_of(p.geometry, r.acting).force, sum_of(held), sum_of(pressed)};
}

namespace {

/// A node of a bed, with its pair or, if it is fixed, its force on the support.
struct bed_node {
  int node;
  const pair_reading& at;
  bool in_contact;
  double share;
};

/// Calls visit(bed, node) for the nodes of all beds; beds count from 0.
template <class Visit>
void for_each_bed_node(const step_results& r, const Visit& visit) {
  const problem& p = r.what;
  auto held = r.held.begin();
  for (std::size_t n = 0; n < p.beds.size(); ++n) {
    const bed& b = p.beds[n];
    for (std::size_t i = 0; i < b.share.size(); ++i) {
      const std::size_t pair = b.first_pair + i;
      visit(n, bed_node{p.pairs[pair].node, r.pairs[pair], r.state.closed(pair), b.share[i]});
    }
    for (std::size_t i = 0; i < b.held.size(); ++i, ++held)
      visit(n, bed_node{b.held[i].node, *held, held->gap == 0.0, b.held_share[i]});
  }
}

}  // namespace

std::vector<bed_reading> beds_in(const step_results& r) {
  std::vector<bed_reading> all(r.what.beds.size());
  for_each_bed_node(r, [&](std::size_t bed, const bed_node& of) {
    bed_reading& sum = all[bed];
    const place at = place_of_node(r.what.geometry, of.node);
    const placed_value here{of.at.force / of.share, at.x, at.y, of.node};
    const bool is_first = sum.pressure.most.node < 0;
    if (is_first || here.value < sum.pressure.least.value) sum.pressure.least = here;
    if (is_first || here.value > sum.pressure.most.value) sum.pressure.most = here;
    sum.force += of.at.force;
    if (of.in_contact) sum.contact += of.share;
  });
  return all;
}

std::vector<double> bed_pressure(const step_results& r) {
  std::vector<double> at(nodes(r.what.geometry));
  for_each_bed_node(r, [&at](std::size_t /*bed*/, const bed_node& of) {
    if (of.share > 0.0) at[of.node] += of.at.force / of.share;
  });
  return at;
}

std::optional<penetration> deepest_penetration(const problem& p, const load& l, std::span<const double> u) {
  constexpr double worth_a_word = 1e-3;
  const auto* const b = std::get_if<beam>(&p.geometry.kind);
  if (b == nullptr) return {};
  const std::vector<pair_in<double>> pairs = pairs_under(p, l);
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::pair(pairs[i].surface, pairs[i].dof); });
  const beam_lines lines(*b, l, u);
  penetration worst;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const pair_in<double>& left = pairs[order[i]];
    const pair_in<double>& right = pairs[order[i + 1]];
    if (left.surface != right.surface || left.face != right.face || left.dof == right.dof) continue;
    if (std::min(order[i], order[i + 1]) >= contacts_of(p)) continue;  // a bed, whose pairs yield
    const value_range w = deflections_between(lines, u, p.pairs[order[i]].node, p.pairs[order[i + 1]].node);
    const placed_value& outmost = left.surface == face_above ? w.most : w.least;
    const double at_pairs =
        std::max({0.0, depth_of(left, left.seen_in(u)), depth_of(right, right.seen_in(u))});
    const double depth = depth_of(left, outmost.value) - at_pairs;
    if (depth > worst.depth) worst = {depth, outmost.x, order[i], order[i + 1]};
  }
  double largest = 0.0;
  for (int node = 0; node < b->nodes(); ++node)
    largest = std::max(largest, std::abs(deflection_of(p, u, node)));
  if (!(worst.depth > worth_a_word * largest)) return {};
  return worst;
}

std::string_view places_of_extremes(const model& m) {
  constexpr std::string_view places[] = {"the whole length", "nodes and corners of elements", "dofs"};
  return places[m.kind.index()];
}

std::string place_words(const model& m, const placed_value& at) {
  const std::string name = at.name.empty() ? "" : on_one_line(at.name) + ", ";
  if (std::holds_alternative<assembled>(m.kind)) return name + place_words(m, at.node);
  const std::string x = std::holds_alternative<plate>(m.kind) ? fmt::format("({:.6g}, {:.6g})", at.x, at.y)
                                                              : fmt::format("x = {:.6g}", at.x);
  return name + (at.node < 0 ? x : fmt::format("{}, {}", place_words(m, at.node), x));
}

}  // namespace contct
