// Bounds the errors inside the elements of a beam, which can exceed those at their ends.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "contct/certify/error_bounds.hpp"
#include "contct/model/extremes.hpp"

namespace contct {
namespace {

double sum_of_sizes(const std::vector<double>& p) {
  double sum = 0.0;
  for (const double x : p) sum += std::abs(x);
  return sum;
}

/// A bound on the rounding error of a line's polynomial p. Its coefficients above the cubic ones have at most
/// 20 roundings each; two evaluations by Horner's rule and the conversion to Bernstein's form have 6 for each
/// degree, and each of 26 bisections one for each degree. A polynomial without a cubic part is at most its
/// largest coefficient; fitting it to the ends adds at most a quarter of that for each degree.
double rounding_in(const std::vector<double>& p) {
  return 0x1p-53 * sum_of_sizes(p) * (64.0 + 48.0 * static_cast<double>(p.size()));
}

/// An upper bound on the amount by which a polynomial in Bernstein's form exceeds `top`; amounts below
/// `close` do not matter. `reached`: the amount that is certainly exceeded, since the first and last
/// coefficients are values of the polynomial.
double above(std::vector<double> b, double top, double close, int bisections, double& reached) {
  const double beyond = std::ranges::max(b) - top;
  reached = std::max({reached, b.front() - top, b.back() - top});
  if (beyond <= reached + close || bisections == 0) return std::max(beyond, 0.0);
  std::vector<double> left;  // de Casteljau: `b` becomes the right half
  for (std::size_t last = b.size(); last > 0; --last) {
    left.push_back(b.front());
    for (std::size_t i = 0; i + 1 < last; ++i) b[i] = b[i] / 2 + b[i + 1] / 2;
  }
  return std::max(above(std::move(left), top, close, bisections - 1, reached),
                  above(std::move(b), top, close, bisections - 1, reached));
}

/// Bounds the excess of p over its printed extremes, plus its distance from the value at the right end.
double off_extremes(const std::vector<double>& p, const value_range& printed, double right_end) {
  constexpr int bisections = 26;  // a smooth maximum is found to 4^-26 of the polynomial's change
  const double close = rounding_in(p);
  std::vector<double> b = bernstein_of(p);
  double reached = 0.0;
  double beyond = above(b, printed.most.value, close, bisections, reached);
  for (double& x : b) x = -x;
  reached = 0.0;
  beyond = std::max(beyond, above(std::move(b), -printed.least.value, close, bisections, reached));
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
  const std::vector<value_range> printed =
      ranges_of({b}, l, state.displacement, {}, state.numbers.element_values);
  const beam_lines lines(b, l, state.displacement, state.numbers.element_values);
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
      const auto off = [&](const std::vector<double>& p, std::size_t name, double right_end) {
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
