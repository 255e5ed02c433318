// A line of nodes, and polynomials along it, in rational numbers from the decimals of the file.
#pragma once

#include <span>
#include <vector>

#include "contct/numeric/rational.hpp"
#include "contct/structure/problem.hpp"

namespace contct::structure {

/// The points of a line as the file has them: equal parts of its lengths where it gives lengths, otherwise
/// number by number. A point is computed when it is asked for: a long beam has many, and few are.
class exact_line {
 public:
  exact_line(std::span<const double> x, std::span<const even_run> runs)
      : x_(x.begin(), x.end()), runs_(runs.begin(), runs.end()), first_(numeric::decimal_of(x.front())) {
    half_ = (at(x.size() - 1) - first_) / 2;
  }

  [[nodiscard]] std::size_t points() const { return x_.size(); }
  [[nodiscard]] const numeric::rational& half() const { return half_; }
  [[nodiscard]] numeric::rational middle() const { return first_ + half_; }

  [[nodiscard]] numeric::rational at(std::size_t point) const {
    if (runs_.empty()) return numeric::decimal_of(x_[point]);
    numeric::rational start = first_;
    for (const even_run& run : runs_) {
      const auto elements = static_cast<std::size_t>(run.elements);
      const numeric::rational end = numeric::decimal_of(run.end);
      if (point <= elements) return start + (end - start) * static_cast<int>(point) / run.elements;
      point -= elements;
      start = end;
    }
    return start;
  }

  /// From -1 to 1 over the line.
  [[nodiscard]] numeric::rational across(const numeric::rational& x) const {
    return (x - first_) / half_ - 1;
  }

  /// What rounding can make of `across` at any point.
  [[nodiscard]] double rounding() const;

 private:
  std::vector<double> x_;
  std::vector<even_run> runs_;
  numeric::rational first_, half_;
};

/// The polynomial of a distributed load, from its parts in the file where it has several.
[[nodiscard]] inline std::vector<numeric::rational> polynomial_of(const distributed_load& d) {
  std::vector<numeric::rational> sum(d.polynomial.size());
  const auto add = [&sum](std::span<const double> part) {
    for (std::size_t i = 0; i < part.size(); ++i) sum[i] += numeric::decimal_of(part[i]);
  };
  if (d.parts.empty()) add(d.polynomial);
  for (const std::vector<double>& part : d.parts) add(part);
  return sum;
}

}  // namespace contct::structure
