// The numbers of a problem file and the points of a line, as double, double_double or rational.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "contct/number/double_double.hpp"
#include "contct/structure/element_formulas.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

// A number of a file means the shortest decimal that reads as the same double. As a double, it is this
// double. Functions of several numbers compute from the decimals exactly, and round once to double_double:
// see line.cpp.

template <class Number>
[[nodiscard]] Number number_of(double x);

/// a - b. As double_double or rational, computed from the decimals, so that cancellation loses no digits.
template <class Number>
[[nodiscard]] Number difference_of(double a, double b);

/// x times `factor`, the factor of a combination.
template <class Number>
[[nodiscard]] Number product_of(double x, double factor);

/// The sum of the loads at one dof; exactly 0 if their decimals cancel.
template <class Number>
[[nodiscard]] Number sum_of(std::span<const point_load> all);

/// D of a plate; computed as E t^3 / (12 (1 - nu^2)) if the file gives E and t.
template <class Number>
[[nodiscard]] Number stiffness_of(const plate& p);

/// EI of a beam's element, as in the file or as the product of the section's E and I.
template <class Number>
[[nodiscard]] Number stiffness_of(const beam& b, int element);

/// 1 / GA of a beam's element, from the same; 0 without shear flexibility.
template <class Number>
[[nodiscard]] Number shear_flexibility_of(const beam& b, int element);

/// The values of a polynomial in x at nodes of a beam, computed exactly: far from x = 0 the terms of the
/// polynomial may cancel in every digit.
template <class Number>
[[nodiscard]] std::vector<Number> values_at(const beam& b, std::span<const double> polynomial,
                                            std::span<const int> nodes);

/// A run of equal elements, and the index and coordinate of its first point.
struct even_part {
  std::size_t first;
  double start;
  even_run run;
};

/// The points of a line as the file gives them: runs of equal intervals, or one number for each point. In
/// double, the points have their rounded coordinates. A point is computed on demand, because a long beam has
/// many points, and few of them are needed in rational numbers.
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

  [[nodiscard]] std::size_t size() const { return x_.size(); }
  [[nodiscard]] int intervals() const { return static_cast<int>(x_.size()) - 1; }

  [[nodiscard]] Number at(std::size_t point) const {
    if (parts_.empty()) return number_of<Number>(x_[point]);
    const even_part& p = part_from(point);
    const auto length = difference_of<Number>(p.run.end, p.start);
    return number_of<Number>(p.start) + length * static_cast<int>(point - p.first) / p.run.elements;
  }

  [[nodiscard]] Number place(const line_place& p) const {
    if (p.point >= 0) return at(p.point);
    auto sum = number_of<Number>(p.x);
    for (const double more : p.more) sum += number_of<Number>(more);
    return sum;
  }

  /// The last point that is not after `place`, whose rounded value is `near`; 0 if all points are after it.
  [[nodiscard]] std::size_t point_before(const Number& place, double near) const {
    std::size_t next = std::upper_bound(x_.begin(), x_.end(), near) - x_.begin();
    while (next < size() && at(next) <= place) ++next;
    while (next > 1 && at(next - 1) > place) --next;
    return std::max<std::size_t>(next, 1) - 1;
  }

  /// The distance from point `interval` to the next point, without rounding the points.
  [[nodiscard]] Number length(std::size_t interval) const {
    if (parts_.empty()) return difference_of<Number>(x_[interval + 1], x_[interval]);
    return length_in(part_from(interval));
  }

  [[nodiscard]] bool are_equal(std::size_t interval, std::size_t other) const {
    const bool are_parts_of_one = !parts_.empty() && &part_from(interval) == &part_from(other);
    return are_parts_of_one || length(interval) == length(other);
  }

  [[nodiscard]] std::vector<Number> lengths() const {
    std::vector<Number> all;
    all.reserve(intervals());
    for (const even_part& p : parts_) all.resize(all.size() + p.run.elements, length_in(p));
    for (int i = 0; parts_.empty() && i < intervals(); ++i) all.push_back(length(i));
    return all;
  }

 private:
  [[nodiscard]] static Number length_in(const even_part& p) {
    return difference_of<Number>(p.run.end, p.start) / p.run.elements;
  }
  [[nodiscard]] const even_part& part_from(std::size_t point) const {
    const auto is_before = [](std::size_t wanted, const even_part& p) { return wanted < p.first; };
    return *(std::upper_bound(parts_.begin(), parts_.end(), point, is_before) - 1);
  }

  std::vector<double> x_;
  std::vector<even_part> parts_;
};

/// The tributary length of each point of a line: half of each adjacent interval.
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

}  // namespace contct
