// Bounds the errors inside the elements of a beam, which can exceed the errors at the ends of the elements.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "contct/proof/error_bounds.hpp"
#include "contct/structure/extremes.hpp"

namespace contct {
namespace {

using poly = line_polynomial<double>;

/// A bound on the rounding of the values of p, a polynomial of an element_line. Each coefficient above degree
/// 3 has at most 20 roundings. For each degree, two evaluations by Horner's rule and the conversion to
/// Bernstein's form have 6 roundings, and 26 bisections have 26. The terms above degree 3 add up to at most
/// the sum of their coefficients; the Hermite functions that fit them to the ends of the element add at most
/// a quarter of this sum for each degree.
double rounding_in(const poly& p) {
  return 0x1p-53 * sum_of_sizes(p) * (64.0 + 48.0 * static_cast<double>(p.size()));
}

/// A bound on the rounding of the slopes of an element_line, of which any may be printed. Each coefficient
/// has at most 20 roundings, and a value by Horner's rule 2 for each degree; both enter the value and the
/// right end to which it is compared.
double rounding_in_slope(const poly& p) {
  return 0x1p-53 * sum_of_sizes(p) * (40.0 + 4.0 * static_cast<double>(p.size()));
}

/// A bound on how far a polynomial, with Bernstein's coefficients p, exceeds `top` from t = 0 to 1. Bisects p
/// until the bound is at most `close` above `reached`, the largest excess of a value so far: the first and
/// the last coefficient are the values at t = 0 and 1.
double above(const poly& p, double top, double close, int bisections, double& reached) {
  const double beyond = std::ranges::max(p) - top;
  reached = std::max({reached, p.front() - top, p.back() - top});
  if (beyond <= reached + close || bisections == 0) return std::max(beyond, 0.0);
  poly left;  // P. de Casteljau
  poly right = p;
  for (std::size_t last = p.size(); last > 0; --last) {
    left.push_back(right.front());
    for (std::size_t i = 0; i + 1 < last; ++i) right[i] = right[i] / 2 + right[i + 1] / 2;
  }
  return std::max(above(left, top, close, bisections - 1, reached),
                  above(right, top, close, bisections - 1, reached));
}

constexpr int bisections = 26;  // a half each: a smooth maximum is found to 4^-26 of the change in t

/// A bound on how far p goes beyond its printed extremes, plus its distance from the reported value at its
/// right end, plus rounding.
double off_extremes(const poly& p, const value_range& printed, double right_end) {
  const double close = rounding_in(p);
  poly b = bernstein_of(p);
  double reached = 0.0;
  double beyond = above(b, printed.most.value, close, bisections, reached);
  for (double& x : b) x = -x;
  reached = 0.0;
  beyond = std::max(beyond, above(b, -printed.least.value, close, bisections, reached));
  return beyond + std::abs(polynomial_at(p, 1.0) - right_end) + close;
}

/// Takes sizes inside an element of length h: of w and moment in its middle, of the shear at a quarter, where
/// it does not vanish by symmetry. Without shear flexibility, the largest slope is at least the mean slope of
/// each half.
void take_inside(const std::vector<element_line>& pieces, double h, double w_left, double w_right,
                 bool shears, by_quantity& size) {
  const auto at = [&pieces](double left, poly element_line::*of) {
    auto line = pieces.begin();
    for (; line + 1 != pieces.end() && left > line->h; ++line) left -= line->h;
    return polynomial_at((*line).*of, std::min(left / line->h, 1.0));
  };
  const double w = at(h / 2, &element_line::w);
  size.take(quantity::w, std::abs(w));
  if (!shears) size.take(quantity::slope, std::max(std::abs(w - w_left), std::abs(w_right - w)) / (h / 2));
  size.take(quantity::moment, std::abs(at(h / 2, &element_line::moment)));
  size.take(quantity::shear, std::abs(at(h / 4, &element_line::shear)));
}

/// Widens the bounds by how far each element goes beyond the printed extremes, and by the error of w inside
/// the element. Up to rounding, the error of the moment is linear and that of the shear constant, so both are
/// largest at the ends. The error of w is a cubic, the sum of Hermite's functions times the errors at the
/// ends: the functions of w add up to 1, those of the slopes to at most h / 4. This also holds if loads break
/// an element into pieces, because the loads are those of the equilibrium, and with shear flexibility.
///
/// Left of a hinge, the slope at the hinge is not a dof: the curvature there, which has the error of the
/// moment (none if the hinge is free) and rounding, replaces the right slope. The functions of w and of the
/// left slope have the same bounds, that of the curvature is at most h^2 / 27, with shear flexibility h^2
/// / 8.
///
/// The error of the slope is quadratic. It is at most the largest error at the ends, plus the smaller of two
/// numbers, which bound it by the errors of w at the ends and by that of the shear. Left of a hinge, the
/// error of the curvature, times h, replaces that of the right slope.
void widen(const beam& b, const structure_state& state, const load& l, error_bounds& bounds) {
  const beam_lines lines(b, l, state.displacement, state.numbers.element_values);
  const std::vector<value_range> printed = ranges_of(b, lines, state.displacement);
  by_quantity& error = bounds.error;
  by_quantity inside;
  // Under loads on fixed dofs alone, only reactions have errors.
  const bool still = error[quantity::w] == 0.0 && error[quantity::slope] == 0.0 &&
                     std::ranges::all_of(state.displacement, [](double u) { return u == 0.0; });
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    const element_line& last = pieces.back();
    double h = 0.0;
    for (const element_line& line : pieces) h += line.h;
    const std::size_t right = 2 * e + 2;
    const bool hinge = b.has_hinge(e + 1);
    const double right_moment = lines.ends().at(e, 1)[1];
    const double of_moment = still                             ? 0x1p-50 * std::abs(right_moment)
                             : b.stiffness_of_hinge(e + 1) > 0 ? error[quantity::moment].value_or(0.0)
                                                               : 0.0;
    const auto flexibility = shear_flexibility_of<double>(b, e);
    const double slope = hinge ? (std::abs(polynomial_at(last.moment, 1.0) - right_moment) + of_moment) * h /
                                     (flexibility > 0 ? 2 : 6) / b.EI[e]
                               : std::abs(polynomial_at(last.slope, 1.0) - state.displacement[right + 1]);
    const double w = std::abs(polynomial_at(last.w, 1.0) - state.displacement[right]);
    const double turned = std::min(1.5 / h * (2 * error[quantity::w].value_or(0.0) + w),
                                   h * h / b.EI[e] / (hinge ? 2 : 8) * error[quantity::shear].value_or(0.0));
    const double of_slope = h / 4 * (error[quantity::slope].value_or(0.0) + slope);
    // The sum of loads that cancel has an error of up to 2^-89 of their magnitudes.
    const double of_load = 0x1p-80 * last.load_size * h;
    take_inside(pieces, h, state.displacement[right - 2], state.displacement[right], flexibility > 0,
                bounds.size);
    for (const element_line& line : pieces) {
      const auto off = [&](const poly& p, std::size_t name, double right_end) {
        return off_extremes(p, printed[name], &line == &last ? right_end : polynomial_at(p, 1.0));
      };
      if (line.load_size != 0.0) {  // without a load, shear and moment are extreme at the ends
        inside.take(quantity::shear, of_load + off(line.shear, 2, lines.ends().at(e, 0)[1]));
        inside.take(quantity::moment, of_load * h + off(line.moment, 1, right_moment));
      }
      // The deflection by shear is rounded apart from that by bending.
      const double by_shear = flexibility * h * (of_load + 0x1p-48 * sum_of_sizes(line.shear));
      inside.take(quantity::w, of_load * h * h * h / b.EI[e] + of_slope + by_shear +
                                   off(line.w, 0, state.displacement[right]));
      inside.take(quantity::slope, of_load * h * h / b.EI[e] + (hinge ? 6 : 1) * slope + turned +
                                       rounding_in_slope(line.slope));
    }
  }
  for (const quantity q : {quantity::w, quantity::slope, quantity::moment, quantity::shear})
    if (error[q]) error.take(q, (*error[q] + inside[q].value_or(0.0)) * (1 + summation_slack));
}

}  // namespace

double bound_on_largest(const poly& p, double close) {
  const poly b = bernstein_of(p);
  const double top = std::max(b.front(), b.back());
  double reached = 0.0;
  return top + above(b, top, close, bisections, reached) + rounding_in(p);
}

void widen_by_extremes(const problem& p, const structure_state& state, error_bounds& b) {
  if (const auto* const of_beam = std::get_if<beam>(&p.geometry.kind))
    widen(*of_beam, state, b.unloaded ? load{} : p.steps[state.step - 1], b);
}

}  // namespace contct
