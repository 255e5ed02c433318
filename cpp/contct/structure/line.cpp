#include "contct/structure/line.hpp"

#include <cmath>

#include "contct/structure/acting.hpp"

namespace contct {
namespace {

/// True for whole numbers below 2^52: the sum or difference of two of them is a double.
bool is_whole(double x) {
  return x == std::trunc(x) && std::abs(x) < 0x1p52;
}

rational product_of_decimals(double x, double factor) {
  return factor == 1.0 ? decimal_of(x) : rational(decimal_of(x) * decimal_of(factor));
}

rational exact_sum_of(std::span<const point_load> all) {
  rational sum;
  for (const point_load& p : all) sum += product_of_decimals(p.value, p.factor);
  return sum;
}

}  // namespace

template <class Number>
Number number_of(double x) {
  if (std::is_same_v<Number, double> || is_whole(x)) return Number(x);
  if constexpr (std::is_same_v<Number, double_double>) return long_decimal_of(x);
  return nearest<Number>(decimal_of(x));
}

template <class Number>
Number difference_of(double a, double b) {
  if (std::is_same_v<Number, double> || (is_whole(a) && is_whole(b))) return Number(a - b);
  return nearest<Number>(decimal_of(a) - decimal_of(b));
}

template <class Number>
Number product_of(double x, double factor) {
  return factor == 1.0 ? number_of<Number>(x) : nearest<Number>(product_of_decimals(x, factor));
}

template <class Number>
Number sum_of(std::span<const point_load> all) {
  if constexpr (!std::is_same_v<Number, double>) return nearest<Number>(exact_sum_of(all));
  if (all.size() > 1 && exact_sum_of(all) == 0) return Number(0);
  Number sum(0);
  for (const point_load& p : all) sum += product_of<Number>(p.value, p.factor);
  return sum;
}

rational_vector coefficients_of(const distributed_load& d) {
  rational_vector sum(d.polynomial.size());
  const auto add = [&sum](std::span<const double> part, double factor, double times) {
    for (std::size_t i = 0; i < part.size(); ++i)
      sum[i] += product_of_decimals(part[i], factor) * decimal_of(times);
  };
  if (d.parts.empty()) add(d.polynomial, 1.0, 1.0);
  for (const scaled_polynomial& part : d.parts) add(part.coefficients, part.factor, part.times);
  return sum;
}

rational_vector coefficients_of(const placed_load& p) {
  rational_vector all;
  for (const double a : p.polynomial) all.push_back(product_of_decimals(a, p.factor));
  return all;
}

template <class Number>
Number stiffness_of(const plate& p) {
  if (p.E == 0 || std::is_same_v<Number, double>) return number_of<Number>(p.D);
  const rational nu = decimal_of(p.nu);
  const rational t = decimal_of(p.thickness);
  return nearest<Number>(decimal_of(p.E) * t * t * t / (12 * (1 - nu * nu)));
}

template <class Number>
Number stiffness_of(const beam& b, int element) {
  if (b.sections.empty() || std::is_same_v<Number, double>) return number_of<Number>(b.EI[element]);
  return product_of<Number>(b.sections[element].E, b.sections[element].I);
}

template <class Number>
Number shear_flexibility_of(const beam& b, int element) {
  if (b.GA.empty()) return Number(0);
  if constexpr (std::is_same_v<Number, double>) return 1 / b.GA[element];
  const rational GA = b.sections.empty() ? decimal_of(b.GA[element])
                                         : product_of_decimals(b.sections[element].G, b.sections[element].As);
  return nearest<Number>(1 / GA);
}

template <class Number>
std::vector<Number> values_at(const beam& b, std::span<const double> polynomial, std::span<const int> nodes) {
  const line<rational> x(b.x, b.runs);
  const auto a = coefficients_of(distributed_load{{polynomial.begin(), polynomial.end()}, {}});
  std::vector<Number> values;
  for (const int node : nodes) values.push_back(nearest<Number>(polynomial_at(a, x.at(node))));
  return values;
}

template double number_of(double x);
template double_double number_of(double x);
template rational number_of(double x);
template double difference_of(double a, double b);
template double_double difference_of(double a, double b);
template rational difference_of(double a, double b);
template double product_of(double x, double factor);
template double_double product_of(double x, double factor);
template rational product_of(double x, double factor);
template double sum_of(std::span<const point_load> all);
template double_double sum_of(std::span<const point_load> all);
template rational sum_of(std::span<const point_load> all);
template double stiffness_of(const plate& p);
template double_double stiffness_of(const plate& p);
template rational stiffness_of(const plate& p);
template double stiffness_of(const beam& b, int element);
template double_double stiffness_of(const beam& b, int element);
template rational stiffness_of(const beam& b, int element);
template double shear_flexibility_of(const beam& b, int element);
template double_double shear_flexibility_of(const beam& b, int element);
template rational shear_flexibility_of(const beam& b, int element);
template std::vector<double> values_at(const beam&, std::span<const double>, std::span<const int>);
template std::vector<double_double> values_at(const beam&, std::span<const double>, std::span<const int>);
template std::vector<rational> values_at(const beam&, std::span<const double>, std::span<const int>);

}  // namespace contct
