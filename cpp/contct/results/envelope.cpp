#include "contct/results/envelope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "contct/results/load_path.hpp"
#include "contct/results/path_states.hpp"

namespace contct {
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

/// Widens the ranges of `all` by a state. The first state replaces infinite values.
void take(envelope& all, const step_results& r) {
  const structure_state& s = r.state;
  const std::vector<watched_range> watched = watched_in(r);
  if (all.states++ == 0) {
    all.watched = watched;
    all.values_watched.assign(watched.size(), {{{infinite}}, {{-infinite}}});
    for (const value_range& v : r.ranges()) all.names.push_back(v.name);
    all.values.assign(all.names.size(), {{{infinite}}, {{-infinite}}});
    for (const on where : {on::supports, on::beds, on::hinges, on::pairs})
      for (const quantity_row* row : quantities_of(r.what, where))
        if (where != on::pairs || row->kind) all.lists.push_back({row, {}});  // a face is no result
  }
  for (std::size_t i = 0; i < all.values.size(); ++i)
    take(all.values[i], r.ranges()[i].least, r.ranges()[i].most, s, std::mem_fn(&placed_value::value));
  for (std::size_t i = 0; i < watched.size(); ++i)
    take(all.values_watched[i], watched[i].least, watched[i].most, s, std::mem_fn(&placed_value::value));
  for (auto& [row, at] : all.lists) {
    const std::vector<double> values = row->values(r);
    at.resize(values.size(), {{infinite}, {-infinite}});
    for (std::size_t i = 0; i < values.size(); ++i) take(at[i], values[i], values[i], s, std::identity{});
  }
}

/// Calls visit(state) for each state of the envelope.
template <class Visit>
void for_each_state_of_envelope(const run_result& r, const Visit& visit) {
  path_states states(r);
  const bool of_combinations = starts_from_zero(r.what);
  for (const path_moment& m : moments_of(r)) {
    if (of_combinations && (!m.is_end || m.step->fraction < 1.0)) continue;
    structure_state s = states.at(m);
    if (s.displacement.empty()) continue;
    if (!m.is_end) s.numbers = {};  // numbers within a step are computed from the displacement
    visit(s);
  }
}

/// The number of parts into which curves_of divides an element.
int parts_of(const beam& b) {
  constexpr int enough = 480;
  return (enough + b.elements() - 1) / b.elements();
}

/// The row of the pressure of beds, which is linear between nodes; none without beds.
std::vector<const quantity_row*> rows_of_beds(const problem& p) {
  std::vector<const quantity_row*> rows = quantities_of(p, on::nodes);
  std::erase_if(rows, [](const quantity_row* row) { return row->kind.has_value(); });
  return rows;
}

/// The curves before the first state: all places, with infinite values that any state replaces.
envelope_curves begun(const problem& p, const beam& b) {
  envelope_curves all;
  const int parts = parts_of(b);
  for (int e = 0; e < b.elements(); ++e)
    for (int k = 0; k <= parts; ++k)
      all.x.push_back(k == parts ? b.x[e + 1] : b.x[e] + b.length_of(e) * k / parts);
  const auto add = [&all](std::string_view key) {
    all.curves.push_back({key, {all.x.size(), {{infinite}, {-infinite}}}});
  };
  for (const line_row& row : along_beam) add(row.key);
  for (const quantity_row* row : rows_of_beds(p)) add(row->key);
  return all;
}

/// Widens the curves by one state. Values at ends of elements are not taken from polynomials, which round.
/// `at_nodes`: the values of each row of rows_of_beds.
void take(envelope_curves& all, const beam& b, const beam_lines& lines, const structure_state& s,
          const std::vector<std::vector<double>>& at_nodes) {
  constexpr std::size_t lines_of_beam = std::size(along_beam);
  const int parts = parts_of(b);
  std::size_t place = 0;
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    auto piece = pieces.begin();
    const double* const u = &s.displacement[std::size_t{beam::dofs_per_node} * e];
    for (int k = 0; k <= parts; ++k, ++place) {
      while (piece + 1 != pieces.end() && all.x[place] > piece->right) ++piece;
      const double t = (all.x[place] - piece->left) / piece->h;
      const auto& ends = lines.ends();
      const std::array at_ends = {std::array{u[0], u[2]}, std::array{ends.at(e, 1)[0], ends.at(e, 1)[1]},
                                  std::array{ends.at(e, 0)[0], ends.at(e, 0)[1]}};
      for (std::size_t i = 0; i < at_nodes.size(); ++i) {
        const double value =
            at_nodes[i][e] + (at_nodes[i][e + 1] - at_nodes[i][e]) * k / static_cast<double>(parts);
        take(all.curves[lines_of_beam + i].at[place], value, value, s, std::identity{});
      }
      for (std::size_t i = 0; i < lines_of_beam; ++i) {
        const double inside = polynomial_at((*piece).*along_beam[i].polynomial, t);
        const double value = k == 0 ? at_ends[i][0] : k == parts ? at_ends[i][1] : inside;
        take(all.curves[i].at[place], value, value, s, std::identity{});
      }
    }
  }
}

}  // namespace

envelope envelope_of(const run_result& r) {
  envelope all;
  for_each_state_of_envelope(r, [&](const structure_state& s) { take(all, step_results(r.what, s)); });
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
  for (const auto* values : {&e.values, &e.values_watched})
    for (const auto& v : *values) {
      choose(v.least.step);
      choose(v.most.step);
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

envelope_curves curves_of(const run_result& r) {
  const auto* const b = std::get_if<beam>(&r.what.geometry.kind);
  if (b == nullptr) return {};
  envelope_curves all;
  for_each_state_of_envelope(r, [&](const structure_state& s) {
    if (all.x.empty()) all = begun(r.what, *b);
    std::vector<std::vector<double>> at_nodes;
    for (const quantity_row* row : rows_of_beds(r.what))
      at_nodes.push_back(row->values(step_results(r.what, s)));
    const load acting = load_at(r.what, s.step, s.fraction);
    take(all, *b, beam_lines(*b, acting, s.displacement, s.numbers.element_values), s, at_nodes);
  });
  return all;
}

}  // namespace contct
