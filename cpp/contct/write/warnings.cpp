#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/linear/cholesky.hpp"
#include "contct/results/load_path.hpp"
#include "contct/results/quantities.hpp"
#include "contct/write/words.hpp"

namespace contct {

std::string passage_warning(const problem& p, std::span<const solved_step> steps) {
  std::optional<penetration> worst;
  int step = 0;
  for (const solved_step& s : steps) {
    const auto here = deepest_penetration(p, load_at(p, s.step, s.fraction), s.displacement);
    if (!here || (worst && here->depth <= worst->depth)) continue;
    worst = here;
    step = s.step;
  }
  if (!worst) return "";
  const contact_pair& left = p.pairs[worst->first];
  return fmt::format(
      "{}: between {} and {} the beam passes through their common face at {:g} by {:.2g}{} at x = "
      "{:.6g}. "
      "This is right if the pairs are separate stops; if one surface extends between them, put pairs closer "
      "together (at the nodes of a finer mesh: element_size)",
      step_words(p, step), numbered_words(p, on::pairs, worst->first),
      numbered_words(p, on::pairs, worst->second), left.face, worst->depth, unit_words(p, unit::length),
      worst->x);
}

namespace {

/// The concentrated force on `node` of a plate, in words; empty if there is none. Moments are infinite at
/// such a node, except at a corner, where a force causes twisting moments of half its size. Pairs of beds do
/// not count, because each pair represents an area.
std::string concentrated_at(const step_results& r, int node) {
  const problem& p = r.what;
  const auto& on = std::get<plate>(p.geometry.kind);
  const place at = place_of_node(p.geometry, node);
  const bool is_at_end = at.x == on.x.front() || at.x == on.x.back();
  if (is_at_end && (at.y == on.y.front() || at.y == on.y.back())) return "";
  for (const point_load& f : r.acting.points)
    if (f.node == node && f.value * f.factor != 0.0) return "a point load";
  for (std::size_t i = 0; i < contacts_of(p); ++i)
    if (p.pairs[i].node == node && r.pairs[i].force != 0.0)
      return "the force of " + numbered_words(p, on::pairs, i);
  return "";
}

}  // namespace

std::string concentration_warning(const problem& p, std::span<const solved_step> steps) {
  if (!std::holds_alternative<plate>(p.geometry.kind)) return "";
  std::size_t rank = 3;
  double most = 0.0;
  std::string warning;
  for (const solved_step& s : steps) {
    const step_results r(p, s);
    const std::vector<value_range>& ranges = r.ranges();
    const bool has_stress = row_named(p, ranges.back().name).in == unit::stress;
    const std::size_t in_order[] = {ranges.size() - 1, 1, 2};  // von Mises, or else mx, or else my
    for (std::size_t here = has_stress ? 0 : 1; here < std::size(in_order); ++here) {
      const placed_value& at = ranges[in_order[here]].largest();
      const double size = std::abs(at.value);
      if (here > rank || (here == rank && size <= most)) continue;
      const std::string what = concentrated_at(r, at.node);
      if (what.empty()) continue;
      rank = here;
      most = size;
      warning = fmt::format(
          "{}: largest {} at {}, under {}: there the moments of a thin plate grow with every finer mesh. "
          "Spread the load, or the force of a bolt, over an area (uniform or moment with from and to) for "
          "a finite stress",
          step_words(p, s.step), here == 0 ? "von Mises" : ranges[here].name, place_words(p.geometry, at),
          what);
    }
  }
  return warning;
}

std::string size_warning(const problem& p, std::span<const solved_step> steps) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return "";
  constexpr double large_slope = 0.1;
  const auto* const on = std::get_if<plate>(&p.geometry.kind);
  const place first = place_of_node(p.geometry, 0);
  const place last = place_of_node(p.geometry, nodes(p.geometry) - 1);
  const bool has_thickness = on != nullptr && on->thickness > 0.0;
  const double length = on == nullptr ? last.x - first.x : std::min(last.x - first.x, last.y - first.y);
  const double large = has_thickness ? on->thickness / 2 : length / 10;
  double w = 0.0;
  double slope = 0.0;
  int step = 0;  // that with the largest of both, as shares of what is large
  for (const solved_step& s : steps) {
    const double before = std::max(w / large, slope / large_slope);
    const auto stride = static_cast<std::size_t>(dofs_per_node(p.geometry));
    for (std::size_t dof = 0; dof < s.displacement.size(); ++dof) {
      double& most = dof % stride == 0 ? w : slope;
      most = std::max(most, std::abs(s.displacement[dof]));
    }
    if (std::max(w / large, slope / large_slope) > before) step = s.step;
  }
  if (w <= large && slope <= large_slope) return "";
  const std::string in = unit_words(p, unit::length);
  const std::string found =
      w > large ? fmt::format("deflection of {:.3g}{}", w, in) : fmt::format("slope of {:.3g}", slope);
  const std::string_view of = has_thickness   ? "half the thickness"
                              : on == nullptr ? "a tenth of the length"
                                              : "a tenth of the shorter side";
  return fmt::format(
      "{}: a {}; results assume small displacements: deflections up to {}, {:.3g}{}, and slopes up to {}",
      step_words(p, step), found, of, large, in, large_slope);
}

std::string digit_warning(std::span<const solved_step> steps) {
  int fewest = 5;  // a state with 5 digits needs no warning
  const solved_step* worst = nullptr;
  for (const solved_step& s : steps) {
    // Refined states and states of the exact path do not lose digits.
    if (s.numbers.any() || s.from == origin::exact_path || digits_left(s.rcond) >= fewest) continue;
    fewest = digits_left(s.rcond);
    worst = &s;
  }
  if (worst == nullptr) return "";
  const std::string digits = fewest == 0   ? "no digit"
                             : fewest == 1 ? "about 1 digit"
                                           : fmt::format("about {} digits", fewest);
  return fmt::format(
      "step {}: {} of the answer can be relied on: the stiffness is ill-conditioned (rcond {:.1e}). Use "
      "fewer elements in a span, or more supports",
      worst->step, digits, worst->rcond);
}

std::vector<std::string> state_warnings(const run_result& r) {
  std::vector<std::string> lines = {r.end.status == path_status::solved ? digit_warning(r.record.steps) : "",
                                    size_warning(r.what, r.record.steps),
                                    passage_warning(r.what, r.record.steps),
                                    concentration_warning(r.what, r.record.steps)};
  std::erase(lines, "");
  return lines;
}

std::vector<std::string> warnings_of(const run_result& r) {
  std::vector<std::string> lines = r.what.warnings;
  const std::string begin = (r.file == "-" ? "standard input" : r.file) + ":";
  for (std::string& line : lines)  // so that results do not depend on the problem's folder
    if (line.starts_with(begin)) line.erase(0, line.find(": ", begin.size()) + 2);
  std::ranges::move(state_warnings(r), std::back_inserter(lines));
  return lines;
}

}  // namespace contct
