#include "contct/session/step_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "contct/kernel/contct.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/session/path_states.hpp"

namespace contct {
namespace {

/// Of numbers that differ only by rounding, the first one counts as the largest.
constexpr double above_ties = 1 + 1e-9;

}  // namespace

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

std::optional<std::size_t> extreme_support(const problem& p, int side,
                                           const std::function<double(std::size_t)>& force_of) {
  const auto* const a = std::get_if<assembled>(&p.geometry.kind);
  std::optional<std::size_t> most;
  for (std::size_t i = 0; i < p.supports.size(); ++i) {
    const bool is_moment = p.supports[i].dof != 0 || (a != nullptr && a->places.known() &&
                                                      a->places.dofs[p.supports[i].node].direction > 3);
    const double force = force_of(i);
    if (!is_moment && (!most || side * (force - force_of(*most)) > tie_of(std::abs(force), 0.0))) most = i;
  }
  return most;
}

std::vector<std::size_t> step_results::hardest_supports(const problem& p) const {
  const auto force_of = [this](std::size_t i) { return reactions[i]; };
  const auto up = extreme_support(p, 1, force_of);
  if (!up) return {};
  std::vector<std::size_t> all = {*up, *extreme_support(p, -1, force_of)};
  if (-reactions[all[1]] > above_ties * reactions[all[0]]) std::swap(all[0], all[1]);
  const auto [most, other] = std::pair(reactions[all[0]], reactions[all[1]]);
  if (most * other >= 0.0 || std::abs(other) <= tie_of(0.0, std::abs(most))) all.pop_back();
  return all;
}

pair_reading reading_of(const contact_pair& p, double w, bool closed) {
  const pair_state look = std::abs(p.face - w) < constants<double>::epsgap ? pair_state::at_face
                          : closed                                         ? pair_state::closed
                                                                           : pair_state::open;
  return {w, gap_of(p, w, closed), force_of(p, w, closed), look, p.face};
}

step_results numbers_of(const problem& p, const load& l, const structure_state& s) {
  const std::vector<double>& u = s.displacement;
  step_results r{{}, results_in_elements(p.geometry, l, u), {}, {}, {}};
  if (s.numbers) r.elements.values = s.numbers->element_values;
  r.reactions = s.numbers ? s.numbers->reactions : reactions(p, l, u, s.isep);
  for (const contact_pair& c : pairs_under(p, l))
    r.pairs.push_back(reading_of(c, c.seen_in(u, dofs_per_node(p.geometry)), s.closed(r.pairs.size())));
  const std::vector<double>& known = s.numbers ? s.numbers->pair_forces : s.pair_forces;
  for (std::size_t i = 0; i < known.size(); ++i) r.pairs[i].force = known[i];
  return r;
}

step_results results_of(const problem& p, const load& l, const structure_state& s) {
  const std::vector<double>& u = s.displacement;
  step_results r = numbers_of(p, l, s);
  r.stresses = stresses_of(p.geometry, r.elements);
  r.ranges = ranges_of(p.geometry, l, u, deflecting_nodes(p), r.elements.values);
  if (const auto* const b = std::get_if<beam>(&p.geometry.kind); b != nullptr && !l.placed.empty()) {
    const beam_lines lines(*b, l, u, r.elements.values);
    for (int e = 0; e < b->elements(); ++e)
      if (lines.is_broken(e)) r.pieces.emplace(e, lines.pieces(e));
  }
  return r;
}

std::optional<force_balance> balance_of(const problem& p, const load& l, const step_results& r) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return {};
  std::vector<double> held;
  std::vector<double> pressed;
  for (std::size_t i = 0; i < r.reactions.size(); ++i)
    if (p.supports[i].dof == 0) held.push_back(r.reactions[i]);
  for (std::size_t i = 0; i < r.pairs.size(); ++i) pressed.push_back(-p.pairs[i].surface * r.pairs[i].force);
  const auto sum_of = [](const std::vector<double>& forces) {  // 0 if the sum is only rounding
    const double sum = std::accumulate(forces.begin(), forces.end(), 0.0);
    const auto add_size = [](double size, double x) { return size + std::abs(x); };
    const double size = std::accumulate(forces.begin(), forces.end(), 0.0, add_size);
    return std::abs(sum) <= tie_of(0.0, size) ? 0.0 : sum;
  };
  return force_balance{resultant_of(p.geometry, l).force, sum_of(held), sum_of(pressed)};
}

std::vector<bed_reading> beds_in(const problem& p, const step_results& r, const structure_state& s) {
  std::vector<bed_reading> all;
  for (const bed& b : p.beds) {
    bed_reading of_bed;
    for (std::size_t i = 0; i < b.share.size(); ++i) {
      const std::size_t pair = b.first_pair + i;
      const int node = p.pairs[pair].node;
      const place at = place_of_node(p.geometry, node);
      const placed_value here{r.pairs[pair].force / b.share[i], at.x, at.y, node};
      if (i == 0) of_bed.pressure = {"pressure", here, here};
      if (here.value < of_bed.pressure.least.value) of_bed.pressure.least = here;
      if (here.value > of_bed.pressure.most.value) of_bed.pressure.most = here;
      of_bed.force += r.pairs[pair].force;
      if (s.closed(pair)) of_bed.contact += b.share[i];
    }
    all.push_back(of_bed);
  }
  return all;
}

std::vector<double> bed_pressure(const problem& p, const std::vector<pair_reading>& pairs) {
  std::vector<double> at(nodes(p.geometry));
  for (const bed& b : p.beds) {
    for (std::size_t i = 0; i < b.share.size(); ++i) {
      const std::size_t pair = b.first_pair + i;
      if (b.share[i] > 0.0) at[p.pairs[pair].node] += pairs[pair].force / b.share[i];
    }
  }
  return at;
}

std::optional<penetration> deepest_penetration(const problem& p, const load& l, std::span<const double> u) {
  constexpr double worth_a_word = 1e-3;
  const auto* const b = std::get_if<beam>(&p.geometry.kind);
  if (b == nullptr) return {};
  const std::vector<contact_pair> pairs = pairs_under(p, l);
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::pair(pairs[i].surface, pairs[i].node); });
  const beam_lines lines(*b, l, u);
  const auto beyond = [&](const contact_pair& c, double w) { return c.surface * (w - c.face); };
  penetration worst;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const contact_pair& left = pairs[order[i]];
    const contact_pair& right = pairs[order[i + 1]];
    if (left.surface != right.surface || left.face != right.face || left.node == right.node) continue;
    if (std::min(order[i], order[i + 1]) >= contacts_of(p)) continue;  // a bed, whose pairs yield
    const value_range w = deflections_between(lines, u, left.node, right.node);
    const placed_value& outmost = left.surface == face_above ? w.most : w.least;
    const double at_pairs = std::max(
        {0.0, beyond(left, deflection_of(p, u, left.node)), beyond(right, deflection_of(p, u, right.node))});
    const double depth = beyond(left, outmost.value) - at_pairs;
    if (depth > worst.depth) worst = {depth, outmost.x, order[i], order[i + 1]};
  }
  double largest = 0.0;
  for (int node = 0; node < b->nodes(); ++node)
    largest = std::max(largest, std::abs(deflection_of(p, u, node)));
  if (!(worst.depth > worth_a_word * largest)) return {};
  return worst;
}

std::string_view ranges_are_at(const model& m) {
  constexpr std::string_view places[] = {"the whole length", "nodes and corners of elements", "dofs"};
  return places[m.kind.index()];
}

std::string place_words(const model& m, const placed_value& at) {
  if (std::holds_alternative<assembled>(m.kind)) return place_words(m, at.node);
  const std::string x = std::holds_alternative<plate>(m.kind) ? fmt::format("({:.6g}, {:.6g})", at.x, at.y)
                                                              : fmt::format("x = {:.6g}", at.x);
  return at.node < 0 ? x : fmt::format("{}, {}", place_words(m, at.node), x);
}

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Widens the extreme `known` (side = 1: the largest value, -1: the least) to the value `now` of state `s`.
/// Of values that are equal (tie_of, with the largest magnitude so far), the first keeps its place and state.
template <class Value>
void take(envelope::reached<Value>& known, int side, Value now, const structure_state& s, auto number_of,
          double largest = 0.0) {
  const double value = number_of(now);
  if (!(side * (value - number_of(known.value)) > 0.0)) return;
  const bool is_equal = known.step > 0 && std::abs(value - known.first) <= tie_of(std::abs(value), largest);
  if (!is_equal) known = {now, s.step, s.number, value};
  number_of(known.value) = value;
}

/// Widens the range `known` to the values `least` and `most` of state `s`.
template <class Value>
void take(envelope::range<Value>& known, const Value& least, const Value& most, const structure_state& s,
          auto number_of) {
  const double largest = std::max({0.0, -number_of(known.least.value), number_of(known.most.value)});
  take(known.least, -1, least, s, number_of, largest);
  take(known.most, 1, most, s, number_of, largest);
}

/// Widens the ranges of `all` by the results `r` of state `s`. The first state replaces infinite values.
void take(envelope& all, const step_results& r, const structure_state& s) {
  if (all.states++ == 0) {
    for (const value_range& v : r.ranges) all.names.push_back(v.name);
    all.values.assign(r.ranges.size(), {{{infinite}}, {{-infinite}}});
    all.pairs.assign(r.pairs.size(), {0.0, s.step, s.number});
    all.reactions.assign(r.reactions.size(), {{infinite}, {-infinite}});
  }
  for (std::size_t i = 0; i < r.ranges.size(); ++i)
    take(all.values[i], r.ranges[i].least, r.ranges[i].most, s, std::mem_fn(&placed_value::value));
  for (std::size_t i = 0; i < r.pairs.size(); ++i)
    take(all.pairs[i], 1, r.pairs[i].force, s, std::identity{});
  for (std::size_t i = 0; i < r.reactions.size(); ++i)
    take(all.reactions[i], r.reactions[i], r.reactions[i], s, std::identity{});
}

/// Calls visit(state, load) for each state of the envelope.
template <class Visit>
void for_each_state_of_envelope(const run_result& r, const Visit& visit) {
  const load_path loads(r.what);
  path_states states(r);
  const bool of_combinations = starts_from_zero(r.what);
  for (const path_moment& m : moments_of(r)) {
    if (of_combinations && (!m.is_end || m.step->end.fraction < 1.0)) continue;
    structure_state s = states.at(m);
    if (s.displacement.empty()) continue;
    s.pair_forces.clear();  // all numbers of an envelope are computed from the displacement
    visit(s, loads.at(s.step, s.fraction));
  }
}

/// The number of parts into which curves_of divides an element.
int parts_of(const beam& b) {
  constexpr int enough = 480;
  return (enough + b.elements() - 1) / b.elements();
}

/// The curves before the first state: all places, with infinite values that any state replaces.
envelope_curves begun(const beam& b) {
  envelope_curves all;
  const int parts = parts_of(b);
  for (int e = 0; e < b.elements(); ++e)
    for (int k = 0; k <= parts; ++k)
      all.x.push_back(k == parts ? b.x[e + 1] : b.x[e] + b.length_of(e) * k / parts);
  for (const std::string_view name : {"w", "moment", "shear"})
    all.curves.push_back({name, {all.x.size(), {{infinite}, {-infinite}}}});
  return all;
}

/// Widens the curves by one state. Values at ends of elements are not taken from polynomials, which round.
void take(envelope_curves& all, const beam& b, const beam_lines& lines, const structure_state& s) {
  const int parts = parts_of(b);
  std::size_t place = 0;
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    auto piece = pieces.begin();
    const double* const u = &s.displacement[std::size_t{beam::dofs_per_node} * e];
    for (int k = 0; k <= parts; ++k, ++place) {
      while (piece + 1 != pieces.end() && all.x[place] > piece->right) ++piece;
      const double t = (all.x[place] - piece->left) / piece->h;
      const auto take_one = [&](std::size_t quantity, const auto& polynomial, double left, double right) {
        const double inside = polynomial_at(polynomial, t);
        const double value = k == 0 ? left : k == parts ? right : inside;
        take(all.curves[quantity].at[place], value, value, s, std::identity{});
      };
      take_one(0, piece->w, u[0], u[2]);
      take_one(1, piece->moment, lines.ends().at(e, 1)[0], lines.ends().at(e, 1)[1]);
      take_one(2, piece->shear, lines.ends().at(e, 0)[0], lines.ends().at(e, 0)[1]);
    }
  }
}

}  // namespace

envelope envelope_of(const run_result& r) {
  envelope all;
  for_each_state_of_envelope(
      r, [&](const structure_state& s, const load& l) { take(all, results_of(r.what, l, s), s); });
  return all;
}

envelope_curves curves_of(const run_result& r) {
  const auto* const b = std::get_if<beam>(&r.what.geometry.kind);
  if (b == nullptr) return {};
  envelope_curves all;
  for_each_state_of_envelope(r, [&](const structure_state& s, const load& l) {
    if (all.x.empty()) all = begun(*b);
    const auto known = s.numbers ? s.numbers->element_values : std::vector<double>{};
    take(all, *b, beam_lines(*b, l, s.displacement, known), s);
  });
  return all;
}

}  // namespace contct
