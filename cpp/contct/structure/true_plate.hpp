// A plate's lengths and stiffness without the rounding of their differences, in numbers of 32 digits.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "contct/numeric/double_double.hpp"
#include "contct/structure/element_formulas.hpp"
#include "contct/structure/problem.hpp"

namespace contct::structure {

/// The points of a line, and the intervals between them, which are not differences of rounded points.
struct long_line {
  std::vector<numeric::double_double> x, h;
};

/// Equal parts of the file's lengths where it gives lengths, otherwise number by number.
[[nodiscard]] inline long_line line_of(std::span<const double> x, std::span<const even_run> runs) {
  using numeric::decimal_difference;
  using numeric::double_double;
  using numeric::long_decimal;
  long_line exactly;
  exactly.x.push_back(long_decimal(x.front()));
  if (runs.empty()) {
    for (std::size_t i = 1; i < x.size(); ++i) {
      exactly.x.push_back(long_decimal(x[i]));
      exactly.h.push_back(decimal_difference(x[i], x[i - 1]));
    }
  }
  double start = x.front();
  for (const even_run& run : runs) {
    const double_double from = exactly.x.back();
    const double_double length = decimal_difference(run.end, start);
    for (int i = 1; i <= run.elements; ++i) {
      exactly.x.push_back(from + length * i / run.elements);
      exactly.h.push_back(length / run.elements);
    }
    start = run.end;
  }
  return exactly;
}

/// D, or E t^3 / 12 (1 - nu^2) where the file has these, rounded once: near nu = -1 the bracket cancels.
[[nodiscard]] numeric::double_double stiffness_of(const plate& p);

/// The stiffness of a plate's elements, one after the other.
class true_element_stiffness {
 public:
  explicit true_element_stiffness(const plate& p)
      : columns_(p.columns()),
        x_(line_of(p.x, p.x_runs)),
        y_(line_of(p.y, p.y_runs)),
        D_(stiffness_of(p)),
        nu_(numeric::long_decimal(p.nu)) {}

  /// Until the next call.
  const std::array<std::array<numeric::double_double, 12>, 12>& operator()(int element) {
    const numeric::double_double a = x_.h[static_cast<std::size_t>(element % (columns_ - 1))] / 2;
    const numeric::double_double b = y_.h[static_cast<std::size_t>(element / (columns_ - 1))] / 2;
    if (!a_ || !(*a_ == a && *b_ == b)) k_ = formulas::plate_stiffness(a, b, D_, nu_);
    a_ = a;
    b_ = b;
    return k_;
  }

 private:
  int columns_;
  long_line x_, y_;
  numeric::double_double D_, nu_;
  std::optional<numeric::double_double> a_, b_;  // of the last element
  std::array<std::array<numeric::double_double, 12>, 12> k_{};
};

}  // namespace contct::structure
