#include "contct/structure/polynomials.hpp"

#include <cmath>
#include <numeric>
#include <optional>

#include "contct/structure/element_formulas.hpp"
#include "contct/structure/exact_numbers.hpp"

namespace contct::structure {

using numeric::double_double;
using numeric::rational;

namespace {

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
load_on_element<double_double> about(const std::vector<double_double>& a, const double_double& left,
                                     const double_double& h) {
  load_on_element<double_double> on{formulas::in_element<double_double>(a, left, h), 0.0};
  double power = 4.0;
  for (const double_double& coefficient : a) {
    on.size += std::abs(coefficient.hi) * power;
    power *= std::abs(left.hi) + h.hi;
  }
  return on;
}

}  // namespace

template <>
std::vector<double_double> coefficients_of(const distributed_load& d) {
  return rounded_once(coefficients_of<rational>(d));
}

template <>
double_double stiffness_of(const plate& p) {
  return p.E == 0.0 ? numeric::long_decimal(p.D) : numeric::long_rounded(stiffness_of<rational>(p));
}

template <>
std::vector<rational> values_at(const beam& b, std::span<const double> polynomial,
                                std::span<const int> nodes) {
  const line<rational> x(b.x, b.runs);
  const std::vector<rational> a = coefficients_of<rational>({{polynomial.begin(), polynomial.end()}, {}});
  std::vector<rational> values;
  for (const int node : nodes) {
    const rational at = x.at(node);
    rational sum;
    for (std::size_t i = a.size(); i-- > 0;) sum = sum * at + a[i];
    values.push_back(sum);
  }
  return values;
}

template <>
std::vector<double> values_at(const beam& b, std::span<const double> polynomial, std::span<const int> nodes) {
  std::vector<double> values;
  for (const rational& x : values_at<rational>(b, polynomial, nodes)) values.push_back(numeric::rounded(x));
  return values;
}

template <>
std::vector<double_double> values_at(const beam& b, std::span<const double> polynomial,
                                     std::span<const int> nodes) {
  return rounded_once(values_at<rational>(b, polynomial, nodes));
}

template <>
void for_each_polynomial(const line<rational>& x, const load& l, const load_visitor<rational>& visit) {
  for (const distributed_load& d : l.distributed) {
    const std::vector<rational> a = coefficients_of<rational>(d);
    for_each_loaded_element(d, x.intervals(), [&](int e) {
      visit(e, {formulas::in_element<rational>(a, x.at(e), x.length(e))});
    });
  }
}

template <>
void for_each_polynomial(const line<double_double>& x, const load& l,
                         const load_visitor<double_double>& visit) {
  constexpr double most_cancelled = 256;  // of what 32 digits keep; beyond that, fractions
  for (const distributed_load& d : l.distributed) {
    const std::vector<rational> exactly = coefficients_of<rational>(d);
    const std::vector<double_double> a = rounded_once(exactly);
    const load_on_element<double_double> uniform{a, std::abs(a[0].hi)};
    std::optional<line<rational>> fractions;
    const auto on = [&](int e) {
      load_on_element<double_double> in_32_digits = about(a, x.at(e), x.length(e));
      if (in_32_digits.size <= most_cancelled * sum_of_sizes(in_32_digits.q)) return in_32_digits;
      if (!fractions) fractions.emplace(x);
      load_on_element<double_double> once{
          rounded_once(formulas::in_element<rational>(exactly, fractions->at(e), fractions->length(e))), 0.0};
      once.size = sum_of_sizes(once.q);
      return once;
    };
    for_each_loaded_element(d, x.intervals(),
                            [&](int e) { a.size() == 1 ? visit(e, uniform) : visit(e, on(e)); });
  }
}

}  // namespace contct::structure
