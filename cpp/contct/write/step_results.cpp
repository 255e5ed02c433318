#include "contct/write/step_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "contct/path/solve_problem.hpp"

namespace contct::write {
namespace {

/// Of numbers that differ by rounding, the first is the largest.
constexpr double above_ties = 1 + 1e-9;

}  // namespace

std::optional<std::size_t> step_results::hardest_pair() const {
  std::optional<std::size_t> hardest;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].force > (hardest ? above_ties * pairs[*hardest].force : 0.0)) hardest = i;
  return hardest;
}

std::optional<std::size_t> step_results::hardest_support(const problem& p) const {
  std::optional<std::size_t> hardest;
  for (std::size_t i = 0; i < reactions.size(); ++i)
    if (p.supports[i].dof == 0 &&
        (!hardest || std::abs(reactions[i]) > above_ties * std::abs(reactions[*hardest])))
      hardest = i;
  return hardest;
}

step_results results_of(const problem& p, const load& l, std::span<const double> u, std::span<const int> isep,
                        std::span<const int> deflecting, const end_numbers* numbers) {
  step_results r{{}, results_in_elements(p.geometry, l, u), {}, {}};
  if (numbers != nullptr) r.elements.values = numbers->element_values;
  r.ranges = ranges_of(p.geometry, l, u, deflecting, r.elements.values);
  r.reactions = numbers != nullptr ? numbers->reactions : reactions(p, l, u, isep);
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    r.pairs.push_back(reading_of(p.pairs[i], deflection_of(p, u, p.pairs[i].node), isep[i] == in_contact));
    if (numbers != nullptr) r.pairs.back().force = numbers->pair_forces[i];
  }
  return r;
}

std::optional<passage> deepest_passage(const problem& p, const load& l, std::span<const double> u) {
  constexpr double worth_a_word = 1e-3;
  const auto* const b = std::get_if<beam>(&p.geometry.kind);
  if (b == nullptr) return {};
  std::vector<std::size_t> order(p.pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::pair(p.pairs[i].surface, p.pairs[i].node); });
  const beam_lines lines(*b, l, u);
  const auto beyond = [&](const contact_pair& c, double w) { return c.surface * (w - c.face); };
  passage worst;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const contact_pair& left = p.pairs[order[i]];
    const contact_pair& right = p.pairs[order[i + 1]];
    if (left.surface != right.surface || left.face != right.face || left.node == right.node) continue;
    const value_range w = deflections_between(*b, lines, u, left.node, right.node);
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

std::vector<double> means_at_nodes(const plate& p, const element_results& results, std::size_t name) {
  std::vector<double> sum(p.nodes());
  std::vector<int> count(p.nodes());
  for (int e = 0; e < p.elements(); ++e) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const int node = p.corners_of(e)[corner];
      sum[node] += results.at(e, name)[corner];
      ++count[node];
    }
  }
  for (std::size_t node = 0; node < sum.size(); ++node) sum[node] /= count[node];
  return sum;
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

std::string unit_words(const problem& p, std::string_view quantity) {
  if (p.units.length.empty() || std::holds_alternative<assembled>(p.geometry.kind)) return "";
  const bool is_slope = quantity == "theta" || quantity == "wx" || quantity == "wy";
  if (is_slope) return "";
  if (quantity == "mx" || quantity == "my" || quantity == "mxy")
    return on_one_line(fmt::format(" {0} {1}/{1}", p.units.force, p.units.length));
  return " " + unit_words(p.units, quantity == "w" ? 0 : 1, quantity == "w" || quantity == "moment" ? 1 : 0);
}

std::string unit_words(const unit_labels& u, int force, int length) {
  constexpr std::string_view powers[] = {"", "", "²", "³"};
  if (u.length.empty()) return "";
  std::string of_length = length == 0 ? "" : u.length + std::string(powers[std::abs(length)]);
  if (force == 0) return of_length;
  return u.force + (length == 0 ? "" : length > 0 ? " " : "/") + of_length;
}

void envelope::take(const frame& f) {
  if (f.step == 0) return;
  const step_results r = results_of(problem_, loads_.at(f.step, f.fraction), f, deflecting_);
  const when now{f.step, f.number};
  if (states_++ == 0) {
    for (const value_range& v : r.ranges) ranges_.push_back({v.name, {v.least, now}, {v.most, now}});
    pairs_.assign(r.pairs.size(), {0.0, now});
    for (const double value : r.reactions) reactions_.push_back({value, value, now, now});
  }
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    if (r.ranges[i].least.value < ranges_[i].least.at.value) ranges_[i].least = {r.ranges[i].least, now};
    if (r.ranges[i].most.value > ranges_[i].most.at.value) ranges_[i].most = {r.ranges[i].most, now};
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (r.pairs[i].force > pairs_[i].force) pairs_[i] = {r.pairs[i].force, now};
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    reaction_range& known = reactions_[i];
    if (r.reactions[i] < known.least) known = {r.reactions[i], known.most, now, known.most_reached};
    if (r.reactions[i] > known.most) known = {known.least, r.reactions[i], known.least_reached, now};
  }
}

}  // namespace contct::write
