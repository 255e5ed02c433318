#include "contct/model/stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace contct {
namespace {

element_results stresses(const beam& b, const element_results& forces) {
  if (b.sections.empty() || b.sections.front().W == 0.0) return {};
  element_results r{{"stress"}, 2, {}};
  for (std::size_t e = 0; e < forces.elements(); ++e)
    for (const double moment : forces.at(e, 1)) r.values.push_back(moment / b.sections[e].W);
  return r;
}

element_results stresses(const plate& p, const element_results& forces) {
  if (p.thickness == 0.0) return {};
  element_results r{{"sx", "sy", "txy", "s1", "s2", "von_mises"}, 4, {}};
  const double of_moment = 6 / p.thickness / p.thickness;
  for (std::size_t e = 0; e < forces.elements(); ++e) {
    std::array<std::array<double, 4>, 6> all{};
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = of_moment * forces.at(e, 0)[k];
      const double y = of_moment * forces.at(e, 1)[k];
      const double xy = of_moment * forces.at(e, 2)[k];
      const double middle = x / 2 + y / 2;
      const double radius = std::hypot(x / 2 - y / 2, xy);
      const std::array<double, 6> at = {
          x, y, xy, middle + radius, middle - radius, std::hypot(middle, std::sqrt(3.0) * radius)};
      for (std::size_t name = 0; name < at.size(); ++name) all[name][k] = at[name];
    }
    for (const auto& of_name : all) r.values.insert(r.values.end(), of_name.begin(), of_name.end());
  }
  return r;
}

element_results stresses(const assembled& /*a*/, const element_results& /*forces*/) {
  return {};
}

}  // namespace

element_results stresses_of(const model& m, const element_results& forces) {
  return std::visit([&](const auto& kind) { return stresses(kind, forces); }, m.kind);
}

/// Stresses are linear in the moments but for the principal and von Mises ones, of which the change of
/// moments by at most 1 each makes at most the root of 6: von Mises' is the root of a positive form, x^2 - x
/// y + y^2 + 3 xy^2 <= 6, and an eigenvalue changes by at most 2. What computes them has few roundings.
std::optional<double> stress_error(const model& m, double moment, double largest) {
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * largest;
  if (const auto* const b = std::get_if<beam>(&m.kind)) {
    if (b->sections.empty() || b->sections.front().W == 0.0) return std::nullopt;
    double least = b->sections.front().W;
    for (const beam_section& s : b->sections) least = std::min(least, s.W);
    return moment / least + rounding;
  }
  const auto* const p = std::get_if<plate>(&m.kind);
  if (p == nullptr || p->thickness == 0.0) return std::nullopt;
  return std::sqrt(6.0) * 6 / p->thickness / p->thickness * moment + rounding;
}

}  // namespace contct
