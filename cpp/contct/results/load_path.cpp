#include "contct/results/load_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contct/structure/line.hpp"

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

load_words words_for(const model& m, const placed_load& p) {
  const std::vector<double> values = values_of(p);
  if (p.is_at_point())
    return {p.what == load_kind::point ? "w " : "theta ", values[0], fmt::format(" at x = {:.6g}", p.from.x)};
  const bool of_plate = std::holds_alternative<plate>(m.kind);
  const bool turns = p.what == load_kind::moment;
  const std::size_t larger = turns && std::abs(values[1]) > std::abs(values[0]) ? 1 : 0;
  std::string before = p.what == load_kind::force ? "uniform " : "curvature ";
  if (turns) before = fmt::format("{} ", dof_names(m)[larger + 1]);
  return {before, values[larger],
          of_plate ? fmt::format(" from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g})", p.from.x, p.across[0].x,
                                 p.to.x, p.across[1].x)
                   : fmt::format(" from {:.6g} to {:.6g}", p.from.x, p.to.x)};
}

load_words words_for(const model& m, const std::string& verb, const nodal_value& g) {
  const std::string name =
      std::holds_alternative<assembled>(m.kind) ? "" : fmt::format("{} ", dof_names(m)[g.dof]);
  return {verb + name, product_of<double>(g.value, g.factor), " at " + place_words(m, g.node)};
}

/// The words for the only part of a load; for the resultant of several forces; or, without forces, for the
/// largest moment, or else the largest curvature, settlement or move of a face.
load_words words_for(const model& m, const load& l, const resultant& r) {
  std::array<std::vector<load_words>, 5> kinds;  // forces, moments, curvatures, settlements, moves
  for (const distributed_load& d : l.distributed) kinds[0].push_back({"uniform ", d.polynomial[0]});
  for (const point_load& p : l.points) kinds[p.dof == 0 ? 0 : 1].push_back(words_for(m, "", p));
  for (const placed_load& p : l.placed)
    kinds[p.what == load_kind::curvature ? 2
          : p.what == load_kind::moment  ? 1
                                         : 0]
        .push_back(words_for(m, p));
  for (const prescribed_displacement& g : l.settlements) kinds[3].push_back(words_for(m, "settle ", g));
  for (const face_move& g : l.moves) kinds[4].push_back(words_for(m, "move face ", g));
  std::size_t parts = 0;
  for (const auto& kind : kinds) parts += kind.size();
  const auto varies = [](const auto& list) { return !list.empty() && list[0].polynomial.size() > 1; };
  const bool is_summed = !kinds[0].empty() && (parts > 1 || varies(l.distributed) || varies(l.placed));
  auto* const kind = std::ranges::find_if(kinds, [](const auto& words) { return !words.empty(); });
  if (is_summed || kind == kinds.end())
    return {std::holds_alternative<assembled>(m.kind) ? "sum " : "force ", r.force};
  load_words& largest =
      *std::ranges::max_element(*kind, {}, [](const load_words& w) { return std::abs(w.value); });
  if (kind->size() > 1) largest.after.clear();
  return largest;
}

/// Returns x, or 0 if x is only the rounding of numbers of magnitude `size`.
double without_rounding(double x, double size) {
  return std::abs(x) <= 32 * std::numeric_limits<double>::epsilon() * size ? 0.0 : x;
}

/// The value at a share of the way from a to b: exactly b at share 1, however large a is.
double between(double a, double b, double share) {
  const double rest = (1.0 - share) * a;
  return without_rounding(rest + share * b, std::max(std::abs(rest), std::abs(share * b)));
}

/// The step whose load acts at the start of `step`; 0 if no load acts.
int step_before(const problem& p, int step) {
  return p.steps[step - 1].from_zero ? 0 : step - 1;
}

}  // namespace

bool is_run(const std::vector<int>& elements) {
  return elements.back() - elements.front() + 1 == static_cast<int>(elements.size()) &&
         std::is_sorted(elements.begin(), elements.end());
}

const resultant& load_path::total_of(int step) const {
  if (!totals_[step])
    totals_[step] = resultant_of(problem_.geometry, step == 0 ? load{} : problem_.steps[step - 1]);
  return *totals_[step];
}

load load_at(const problem& p, int step, double fraction) {
  if (step == 0) return {};
  const int before = step_before(p, step);
  return mix(before > 0 ? p.steps[before - 1] : load{}, p.steps[step - 1], fraction);
}

resultant load_path::resultant_at(int step, double fraction) const {
  const resultant& a = total_of(step_before(problem_, step));
  const resultant& b = total_of(step);
  resultant r{between(a.force, b.force, fraction), a.moments};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    r.moments[i] = between(a.moments[i], b.moments[i], fraction);
  return r;
}

bool load_path::has_many_parts(int step) const {
  constexpr std::size_t most = 32;
  const int before = step_before(problem_, step);
  return std::max(before > 0 ? parts_of(problem_.steps[before - 1]) : 0, parts_of(problem_.steps[step - 1])) >
         most;
}

std::string load_path::words_at(int step, double fraction, int width) const {
  const bool is_sum = has_many_parts(step) &&
                      (total_of(step).force != 0.0 || total_of(step_before(problem_, step)).force != 0.0);
  const auto words_of = [&](double share) {
    return words_for(problem_.geometry, is_sum ? load{} : load_at(problem_, step, share),
                     resultant_at(step, share));
  };
  load_words w = words_of(fraction);
  w.value = without_rounding(w.value, std::max(std::abs(words_of(0.0).value), std::abs(words_of(1.0).value)));
  const auto fits = [width](const std::string& text) { return static_cast<int>(text.size()) <= width; };
  const std::string number = fmt::format("{:.6g}", w.value);
  const std::string rough = w.before + fmt::format("{:.3g}", w.value);
  for (std::string text : {w.before + number + w.after, w.before + number, rough, number})
    if (fits(text)) return text;
  return "";
}

}  // namespace contct
