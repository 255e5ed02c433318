// Pieces that a run's picture is drawn from.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "contct/path/frames.hpp"
#include "contct/structure/problem.hpp"

namespace contct::svg {

inline constexpr double page_width = 900.0;
inline constexpr double picture_top = 96.0;

/// From the least to the largest of what it has taken.
struct span_of {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void take(double x);
  /// Never 0: what is drawn from it divides by it.
  [[nodiscard]] double range() const { return most > least ? most - least : 1.0; }
};

/// A straight scale: numbers onto the page.
struct scale {
  double from, per_unit, at;
  [[nodiscard]] double operator()(double x) const { return at + (x - from) * per_unit; }
};

/// A part of the picture, and where its lower edge is.
struct drawn {
  std::string text;
  double bottom = 0.0;
};

/// 1, 2 or 5 times a power of ten, not above x, which is positive.
[[nodiscard]] double round_down(double x);

/// Round numbers from one to the other, between `about` / 2 and 3 `about` of them.
[[nodiscard]] std::vector<double> ticks(double from, double to, int about);

[[nodiscard]] std::string text_at(double x, double y, std::string_view kind, std::string_view words);
[[nodiscard]] std::string line(double x1, double y1, double x2, double y2, std::string_view kind);
[[nodiscard]] std::string axis_below(const scale& X, double from, double to, double y);

/// A pair at (x, y), told in its tooltip: open is a ring, closed a square, at its face a diamond.
[[nodiscard]] std::string mark_of_pair(const problem& p, const frame& f, std::size_t pair, double x, double y,
                                       double r);

}  // namespace contct::svg
