#include "contct/results/envelope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contct/results/path_states.hpp"

namespace contct {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr envelope::range begun = {{{infinite}}, {{-infinite}}};  // any state replaces these values

/// Widens the extreme `known` (side = 1: the largest value, -1: the least) to the value `now` of state `s`.
/// Of values that are equal (tie_of, with the largest magnitude so far), the first keeps its place and state.
void take(envelope::reached& known, int side, const placed_value& now, const structure_state& s,
          double largest) {
  if (!(side * (now.value - known.value) > 0.0)) return;
  const bool is_equal =
      known.step > 0 && std::abs(now.value - known.first) <= tie_of(std::abs(now.value), largest);
  if (!is_equal) known = {now, s.step, s.number, now.value};
  known.value = now.value;
}

/// Widens the range `known` to the values `least` and `most` of state `s`.
void take(envelope::range& known, const placed_value& least, const placed_value& most,
          const structure_state& s) {
  const double largest = std::max({0.0, -known.least.value, known.most.value});
  take(known.least, -1, least, s, largest);
  take(known.most, 1, most, s, largest);
}

/// Widens the ranges of `all` by a state.
void take(envelope& all, const step_results& r) {
  const std::vector<watched_range> watched = watched_in(r);
  if (all.states++ == 0) {
    for (const value_range& v : r.ranges()) all.values.push_back({&row_named(r.what, v.name), {begun}});
    for (const watched_range& w : watched) all.watched.push_back({w.row, {begun}, w.part});
    for (const on where : {on::supports, on::beds, on::hinges, on::pairs})
      for (const quantity_row* row : quantities_of(r.what, where))
        if (where != on::pairs || row->kind) all.lists.push_back({row});  // a face is no result
  }
  for (std::size_t i = 0; i < all.values.size(); ++i)
    take(all.values[i].at[0], r.ranges()[i].least, r.ranges()[i].most, r.state);
  for (std::size_t i = 0; i < watched.size(); ++i)
    take(all.watched[i].at[0], watched[i].least, watched[i].most, r.state);
  for (envelope::listed& list : all.lists) {
    const std::vector<double> values = list.row->values(r);
    list.at.resize(values.size(), begun);
    const auto node = list_of(list.row->where).node;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const placed_value now =
          node == nullptr ? placed_value{values[i]} : at_node(r.what, values[i], node(r.what, i));
      take(list.at[i], now, now, r.state);
    }
  }
}

/// The number of parts into which the curves divide an element.
int parts_of(const beam& b) {
  constexpr int enough = 480;
  return (enough + b.elements() - 1) / b.elements();
}

/// Begins the curves: all places, without values.
void begin_curves(envelope& all, const problem& p, const beam& b) {
  const int parts = parts_of(b);
  for (int e = 0; e < b.elements(); ++e)
    for (int k = 0; k <= parts; ++k)
      all.x.push_back(k == parts ? b.x[e + 1] : b.x[e] + b.length_of(e) * k / parts);
  for (const line_row& row : along_beam)
    all.curves.push_back({&row_named(p, row.key), {all.x.size(), begun}});
  for (const quantity_row* row : quantities_of(p, on::nodes))  // the pressure of beds is linear between nodes
    if (!row->kind) all.curves.push_back({row, {all.x.size(), begun}});
}

/// Widens the curves by a state. Values at ends of elements are not taken from polynomials, which round.
void take_curves(envelope& all, const beam& b, const step_results& r) {
  constexpr std::size_t lines_of_beam = std::size(along_beam);
  if (all.x.empty()) begin_curves(all, r.what, b);
  std::vector<std::vector<double>> at_nodes;
  for (std::size_t i = lines_of_beam; i < all.curves.size(); ++i)
    at_nodes.push_back(all.curves[i].row->values(r));
  const beam_lines lines = r.lines().value();
  const int parts = parts_of(b);
  std::size_t place = 0;
  const auto widen = [&](std::size_t curve, double value) {
    take(all.curves[curve].at[place], placed_value{value}, placed_value{value}, r.state);
  };
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    auto piece = pieces.begin();
    const double* const u = &r.state.displacement[std::size_t{beam::dofs_per_node} * e];
    const auto& ends = lines.ends();
    const std::array at_ends = {std::array{u[0], u[2]}, std::array{ends.at(e, 1)[0], ends.at(e, 1)[1]},
                                std::array{ends.at(e, 0)[0], ends.at(e, 0)[1]}};
    for (int k = 0; k <= parts; ++k, ++place) {
      while (piece + 1 != pieces.end() && all.x[place] > piece->right) ++piece;
      const double t = (all.x[place] - piece->left) / piece->h;
      for (std::size_t i = 0; i < at_nodes.size(); ++i)
        widen(lines_of_beam + i,
              at_nodes[i][e] + (at_nodes[i][e + 1] - at_nodes[i][e]) * k / static_cast<double>(parts));
      for (std::size_t i = 0; i < lines_of_beam; ++i) {
        const double inside = polynomial_at((*piece).*along_beam[i].polynomial, t);
        widen(i, k == 0 ? at_ends[i][0] : k == parts ? at_ends[i][1] : inside);
      }
    }
  }
}

}  // namespace

envelope envelope_of(const run_result& r, bool with_curves) {
  envelope all;
  path_states states(r);
  const auto* const b = with_curves ? std::get_if<beam>(&r.what.geometry.kind) : nullptr;
  for (const path_moment& m : moments_of(r)) {
    if (starts_from_zero(r.what) && (!m.is_end || m.step->fraction < 1.0)) continue;
    structure_state s = states.at(m);
    if (s.displacement.empty()) continue;
    if (!m.is_end) s.numbers = {};  // numbers within a step are computed from the displacement
    const step_results read(r.what, s);
    take(all, read);
    if (b != nullptr) take_curves(all, *b, read);
  }
  return all;
}

std::set<int> governing_steps(const run_result& r, std::size_t most) {
  std::set<int> chosen;
  const auto choose = [&](int step) {
    if (chosen.size() < most && step > 0) chosen.insert(step);
  };
  for (const solved_step& s : r.record.steps)
    if (s.fraction < 1.0) choose(s.step);
  const envelope e = envelope_of(r);
  for (const auto* values : {&e.values, &e.watched})
    for (const envelope::listed& v : *values) {
      choose(v.at[0].least.step);
      choose(v.at[0].most.step);
    }
  for (const envelope::listed& l : e.lists) {
    const auto value = [](const auto& at) { return at.most.value; };
    if (!l.at.empty()) choose(std::ranges::max_element(l.at, {}, value)->most.step);
  }
  const std::vector<solved_step>& steps = r.record.steps;
  const std::size_t stride = steps.size() / most + 1;
  for (std::size_t i = 0; i < steps.size(); i += stride) choose(steps[i].step);
  for (const solved_step& s : steps) choose(s.step);
  return chosen;
}

}  // namespace contct
