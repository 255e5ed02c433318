// Lines of nodes in numbers of any kind that knows + - * /: doubles, pairs of doubles or rational ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "contct/numeric/double_double.hpp"
#include "contct/structure/problem.hpp"

namespace contct::structure {

/// What a number of a file means: the shortest decimal that reads as it. In doubles it is the number itself.
template <class Number>
[[nodiscard]] Number number_of(double x);

/// The difference of two such numbers, without the rounding of these.
template <class Number>
[[nodiscard]] Number difference_of(double a, double b) {
  return number_of<Number>(a) - number_of<Number>(b);
}

/// The sum of such numbers; exactly 0 where their decimals cancel.
template <class Number>
[[nodiscard]] Number sum_of(std::span<const double> all) {
  Number sum(0);
  for (const double x : all) sum += number_of<Number>(x);
  return sum;
}

template <>
[[nodiscard]] inline double number_of(double x) {
  return x;
}
template <>
[[nodiscard]] inline double sum_of(std::span<const double> all) {
  if (all.size() > 1 && numeric::decimal_sum(all) == 0.0) return 0.0;
  double sum = 0.0;
  for (const double x : all) sum += x;
  return sum;
}

template <>
[[nodiscard]] inline numeric::double_double number_of(double x) {
  return numeric::long_decimal(x);
}
template <>
[[nodiscard]] inline numeric::double_double difference_of(double a, double b) {
  return numeric::decimal_difference(a, b);
}
template <>
[[nodiscard]] inline numeric::double_double sum_of(std::span<const double> all) {
  return numeric::decimal_sum(all);
}

/// Equal elements from a point on.
struct even_part {
  std::size_t first;
  double start;
  even_run run;
};

/// The points of a line as the file has them: equal parts of its lengths where it gives lengths, otherwise
/// number by number. In doubles they are where rounding has put them. A point is computed when it is asked
/// for: a long beam has many, and few are needed in rational numbers.
template <class Number>
class line {
 public:
  line(std::span<const double> x, std::span<const even_run> runs) : x_(x.begin(), x.end()) {
    if (std::is_same_v<Number, double>) return;
    std::size_t first = 0;
    double start = x.front();
    for (const even_run& run : runs) {
      parts_.push_back({first, start, run});
      first += static_cast<std::size_t>(run.elements);
      start = run.end;
    }
  }

  /// The same line in other numbers, none of them double.
  template <class Other>
  explicit line(const line<Other>& other) : x_(other.x_), parts_(other.parts_) {}

  [[nodiscard]] std::size_t size() const { return x_.size(); }
  [[nodiscard]] int intervals() const { return static_cast<int>(x_.size()) - 1; }
  [[nodiscard]] std::span<const double> rounded() const { return x_; }

  [[nodiscard]] Number at(std::size_t point) const {
    if (parts_.empty()) return number_of<Number>(x_[point]);
    const even_part& p = part_from(point);
    const auto length = difference_of<Number>(p.run.end, p.start);
    return number_of<Number>(p.start) + length * static_cast<int>(point - p.first) / p.run.elements;
  }

  /// From a point to the next one: not a difference of rounded points.
  [[nodiscard]] Number length(std::size_t interval) const {
    if (parts_.empty()) return difference_of<Number>(x_[interval + 1], x_[interval]);
    const even_part& p = part_from(interval);
    return difference_of<Number>(p.run.end, p.start) / p.run.elements;
  }

  [[nodiscard]] std::vector<Number> lengths() const {
    std::vector<Number> all;
    all.reserve(intervals());
    for (int i = 0; i < intervals(); ++i) all.push_back(length(i));
    return all;
  }

 private:
  template <class Other>
  friend class line;

  [[nodiscard]] const even_part& part_from(std::size_t point) const {
    const auto is_before = [](std::size_t wanted, const even_part& p) { return wanted < p.first; };
    return *(std::upper_bound(parts_.begin(), parts_.end(), point, is_before) - 1);
  }

  std::vector<double> x_;
  std::vector<even_part> parts_;
};

/// The length that each point of a line stands for: half of each interval beside it.
template <class Number>
[[nodiscard]] std::vector<Number> tributary_lengths(std::span<const Number> intervals) {
  std::vector<Number> lengths(intervals.size() + 1);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const Number half = intervals[i] / 2;
    lengths[i] += half;
    lengths[i + 1] += half;
  }
  return lengths;
}

/// The coefficients of a distributed load: the sums of its parts in the file, where it has several.
template <class Number>
[[nodiscard]] std::vector<Number> coefficients_of(const distributed_load& d);

/// D of a plate, or E t^3 / 12 (1 - nu^2) where the file has these.
template <class Number>
[[nodiscard]] Number stiffness_of(const plate& p);

template <>
[[nodiscard]] inline std::vector<double> coefficients_of(const distributed_load& d) {
  return d.polynomial;
}
template <>
[[nodiscard]] inline double stiffness_of(const plate& p) {
  return p.D;
}

// These come from rational numbers, each rounded once: near nu = -1 the bracket cancels.
template <>
[[nodiscard]] std::vector<numeric::double_double> coefficients_of(const distributed_load& d);
template <>
[[nodiscard]] numeric::double_double stiffness_of(const plate& p);

}  // namespace contct::structure
