#include "contct/session/load_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contct/model/line.hpp"

namespace contct {
namespace {

/// The number of parts of a load; each element of a list that is not consecutive is one part.
std::size_t parts_of(const load& l) {
  std::size_t parts = l.points.size() + l.settlements.size() + l.placed.size() + l.moves.size();
  for (const distributed_load& d : l.distributed)
    parts += d.elements.empty() || is_run(d.elements) ? 1 : d.elements.size();
  return parts;
}

/// A load in words, split at its number.
struct load_words {
  std::string before;
  double value;
  std::string after{};
};

/// The words for a load of only settlements or only moves of faces: for the largest of several.
load_words motion_words(const model& m, const std::string& verb, const std::vector<nodal_value>& all) {
  const auto amount = [](const nodal_value& g) { return product_of<double>(g.value, g.factor); };
  const auto& g = *std::ranges::max_element(all, {}, [&](const auto& one) { return std::abs(amount(one)); });
  if (all.size() > 1) return {verb, amount(g)};
  const std::string name =
      std::holds_alternative<assembled>(m.kind) ? "" : fmt::format("{} ", dof_names(m)[g.dof]);
  return {verb + name, amount(g), " at " + place_words(m, g.node)};
}

load_words words_for(const model& m, const placed_load& p) {
  const double value = values_of(p)[0];
  if (p.what == load_kind::point || p.what == load_kind::moment)
    return {p.what == load_kind::point ? "w " : "theta ", value, fmt::format(" at x = {:.6g}", p.from.x)};
  const bool of_plate = std::holds_alternative<plate>(m.kind);
  return {p.what == load_kind::force ? "uniform " : "curvature ", value,
          of_plate ? fmt::format(" from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g})", p.from.x, p.across[0].x,
                                 p.to.x, p.across[1].x)
                   : fmt::format(" from {:.6g} to {:.6g}", p.from.x, p.to.x)};
}

load_words words_for(const model& m, const load& l, const resultant& r) {
  const bool of_matrix = std::holds_alternative<assembled>(m.kind);
  const auto kinds = std::ranges::count(std::array{l.points.empty(), l.distributed.empty(), l.placed.empty(),
                                                   l.settlements.empty(), l.moves.empty()},
                                        false);
  if (kinds == 1) {
    if (l.placed.size() == 1 && l.placed[0].polynomial.size() == 1) return words_for(m, l.placed[0]);
    if (!l.settlements.empty()) return motion_words(m, "settle ", l.settlements);
    if (!l.moves.empty()) return motion_words(m, "move face ", l.moves);
    if (l.points.size() == 1) {
      const point_load& p = l.points[0];
      return {of_matrix ? "" : fmt::format("{} ", dof_names(m)[p.dof]), product_of<double>(p.value, p.factor),
              " at " + place_words(m, p.node)};
    }
    if (l.distributed.size() == 1 && l.distributed[0].polynomial.size() == 1)
      return {"uniform ", l.distributed[0].polynomial[0]};
  }
  return {of_matrix ? "sum " : "force ", r.force};
}

/// Returns x, or 0 if x is only the rounding of numbers of magnitude `size`.
double without_rounding(double x, double size) {
  return std::abs(x) <= 32 * std::numeric_limits<double>::epsilon() * size ? 0.0 : x;
}

double between(double a, double b, double share) {
  return without_rounding(a + share * (b - a), std::max(std::abs(a), std::abs(b)));
}

}  // namespace

bool is_run(const std::vector<int>& elements) {
  return elements.back() - elements.front() + 1 == static_cast<int>(elements.size()) &&
         std::is_sorted(elements.begin(), elements.end());
}

load_path::load_path(const problem& p) : problem_(p), totals_(p.steps.size() + 1), parts_(1) {
  for (const load& l : p.steps) parts_.push_back(parts_of(l));
}

const resultant& load_path::total_of(int step) const {
  if (!totals_[step])
    totals_[step] = resultant_of(problem_.geometry, step == 0 ? load{} : problem_.steps[step - 1]);
  return *totals_[step];
}

load load_path::at(int step, double fraction) const {
  if (step == 0) return {};
  const int before = step_before(step);
  return mix(before > 0 ? problem_.steps[before - 1] : load{}, problem_.steps[step - 1], fraction);
}

resultant load_path::resultant_at(int step, double fraction) const {
  const resultant& a = total_of(step_before(step));
  const resultant& b = total_of(step);
  resultant r{between(a.force, b.force, fraction), a.moments};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    r.moments[i] = between(a.moments[i], b.moments[i], fraction);
  return r;
}

bool load_path::has_many_parts(int step) const {
  constexpr std::size_t most = 32;
  return std::max(parts_[step_before(step)], parts_[step]) > most;
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

}  // namespace contct
