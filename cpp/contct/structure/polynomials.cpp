#include "contct/structure/polynomials.hpp"

#include <cmath>
#include <numeric>

#include "contct/structure/element_formulas.hpp"
#include "contct/structure/exact_line.hpp"

namespace contct::structure {
namespace {

using numeric::double_double;
using numeric::rational;

std::vector<double_double> rounded_once(std::span<const rational> exactly) {
  std::vector<double_double> all;
  for (const rational& x : exactly) all.push_back(numeric::long_rounded(x));
  return all;
}

double sum_of_sizes(std::span<const double_double> q) {
  return std::accumulate(q.begin(), q.end(), 0.0,
                         [](double sum, const double_double& x) { return sum + std::abs(x.hi); });
}

/// In 32 digits. Coefficients and coordinates are good to 2^-94 and come in at most 21 times, so four times
/// the sum of the terms' magnitudes bounds 2^89 times the error.
load_on_element about(const std::vector<double_double>& a, const double_double& left,
                      const double_double& h) {
  load_on_element on{formulas::in_element<double_double>(a, left, h), 0.0};
  double power = 4.0;
  for (const double_double& coefficient : a) {
    on.size += std::abs(coefficient.hi) * power;
    power *= std::abs(left.hi) + h.hi;
  }
  return on;
}

}  // namespace

std::vector<double_double> values_at(const beam& b, std::span<const double> polynomial,
                                     std::span<const int> nodes) {
  const exact_line line(b.x, b.runs);
  const std::vector<rational> a = polynomial_of({{polynomial.begin(), polynomial.end()}, {}});
  std::vector<double_double> values;
  for (const int node : nodes) {
    const rational x = line.at(static_cast<std::size_t>(node));
    rational sum;
    for (std::size_t i = a.size(); i-- > 0;) sum = sum * x + a[i];
    values.push_back(numeric::long_rounded(sum));
  }
  return values;
}

std::vector<double_double> long_polynomial_of(const distributed_load& d) {
  return rounded_once(polynomial_of(d));
}

loads_on_elements::loads_on_elements(const beam& b)
    : line_(line_of(b.x, b.runs)), exactly_(std::make_shared<exact_line>(b.x, b.runs)) {}

void loads_on_elements::for_each(const load& l,
                                 const std::function<void(int, const load_on_element&)>& visit) const {
  constexpr double most_cancelled = 256;  // of what 32 digits keep; beyond that, fractions
  for (const distributed_load& d : l.distributed) {
    const std::vector<rational> exactly = polynomial_of(d);
    const std::vector<double_double> a = rounded_once(exactly);
    const load_on_element uniform{a, std::abs(a[0].hi)};
    const auto on = [&](int e) {
      const auto at = static_cast<std::size_t>(e);
      load_on_element in_32_digits = about(a, line_.x[at], line_.h[at]);
      if (in_32_digits.size <= most_cancelled * sum_of_sizes(in_32_digits.q)) return in_32_digits;
      const rational left = exactly_->at(at);
      const rational h = exactly_->at(at + 1) - left;
      load_on_element once{rounded_once(formulas::in_element<rational>(exactly, left, h)), 0.0};
      once.size = sum_of_sizes(once.q);
      return once;
    };
    const auto take = [&](int e) { a.size() == 1 ? visit(e, uniform) : visit(e, on(e)); };
    for (const int e : d.elements) take(e);
    for (int e = 0; d.elements.empty() && e < static_cast<int>(line_.h.size()); ++e) take(e);
  }
}

}  // namespace contct::structure
