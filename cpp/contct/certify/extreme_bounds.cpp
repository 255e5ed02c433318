// Bounds the errors inside the elements of a beam, which can exceed those at their ends.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "contct/certify/error_bounds.hpp"
#include "contct/model/extremes.hpp"

namespace contct {
namespace {

using poly = line_polynomial<double>;

double sum_of_sizes(const poly& p) {
  double sum = 0.0;
  for (const double x : p) sum += std::abs(x);
  return sum;
}

/// The largest rounding error of a line's polynomial p: its coefficients above the cubic ones have at most 20
/// roundings each, two rounds of Horner's rule and the conversion to Bernstein's form 6 a degree, and each of
/// 26 bisections one a degree. Of a polynomial without a cubic part the largest value is at most that of its
/// coefficients, and the parts of Hermite's functions that fit it to the ends at most a quarter a degree
/// more.
double rounding_in(const poly& p) {
  return 0x1p-53 * sum_of_sizes(p) * (64.0 + 48.0 * static_cast<double>(p.size()));
}

/// The largest amount by which a polynomial in Bernstein's form exceeds `top`; amounts below `close` do not
/// matter. `reached`: the amount that is certain, since its first and last coefficients are values.
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

/// The distance of the polynomial from its printed extremes, and from the reported value at its right end.
double off_extremes(const poly& p, const value_range& printed, double right_end) {
  constexpr int bisections = 26;  // a half each: a smooth maximum is found to 4^-26 of the change in t
  const double close = rounding_in(p);
  poly b = bernstein_of(p);
  double reached = 0.0;
  double beyond = above(b, printed.most.value, close, bisections, reached);
  for (double& x : b) x = -x;
  reached = 0.0;
  beyond = std::max(beyond, above(b, -printed.least.value, close, bisections, reached));
  return beyond + std::abs(polynomial_at(p, 1.0) - right_end) + close;
}

/// The deflection in the middle of an element of length h.
double middle_of(const std::vector<element_line>& pieces, double h) {
  double left = h / 2;
  for (const element_line& line : pieces) {
    if (left <= line.h) return polynomial_at(line.w, left / line.h);
    left -= line.h;
  }
  return polynomial_at(pieces.back().w, 1.0);
}

/// Up to rounding, the error of M is linear in t and that of V constant, so both are largest at the ends. The
/// error of w is a cubic: Hermite's functions of w add up to 1, those of slopes to at most h / 4.
/// This also holds if loads break an element into pieces, because the loads are those of the equilibrium.
/// Left of a hinge, the error of w is the cubic with the left slope and the right curvature, which is 0 up to
/// rounding. Its functions have the same bounds, and that of the curvature is at most h^2 / 27.
void widen(const beam& b, const reported_state& state, const load& l, error_bounds& bounds) {
  const beam_lines lines(b, l, state.displacement, state.numbers.element_values);
  const std::vector<value_range> printed = ranges_of(b, lines, state.displacement);
  by_quantity& error = bounds.error;
  by_quantity inside;
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    const element_line& last = pieces.back();
    double h = 0.0;
    for (const element_line& line : pieces) h += line.h;
    const std::size_t right = 2 * e + 2;
    const double slope = b.has_hinge(e + 1)
                             ? std::abs(polynomial_at(last.moment, 1.0)) * h / 6 / b.EI[e]
                             : std::abs(polynomial_at(last.slope, 1.0) - state.displacement[right + 1]);
    const double of_slope = h / 4 * (error[quantity::slope].value_or(0.0) + slope);
    // The sum of loads that cancel has an error of up to 2^-89 of their magnitudes.
    const double of_load = 0x1p-80 * last.load_size * h;
    bounds.size.take(quantity::w, std::abs(middle_of(pieces, h)));
    for (const element_line& line : pieces) {
      const auto off = [&](const poly& p, std::size_t name, double right_end) {
        return off_extremes(p, printed[name], &line == &last ? right_end : polynomial_at(p, 1.0));
      };
      if (line.load_size != 0.0) {  // otherwise both extremes are at the ends
        inside.take(quantity::shear, of_load + off(line.shear, 2, lines.ends().at(e, 0)[1]));
        inside.take(quantity::moment, of_load * h + off(line.moment, 1, lines.ends().at(e, 1)[1]));
      }
      inside.take(quantity::w,
                  of_load * h * h * h / b.EI[e] + of_slope + off(line.w, 0, state.displacement[right]));
    }
  }
  for (const quantity q : {quantity::w, quantity::moment, quantity::shear})
    if (error[q]) error.take(q, *error[q] + inside[q].value_or(0.0));
}

}  // namespace

void widen_by_extremes(const problem& p, const reported_state& state, error_bounds& b) {
  if (const auto* const of_beam = std::get_if<beam>(&p.geometry.kind))
    widen(*of_beam, state, b.unloaded ? load{} : p.steps[state.step - 1], b);
}

}  // namespace contct
