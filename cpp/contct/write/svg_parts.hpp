// Pieces of SVG pictures: scales, axes, text, paths, marks.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::write::svg {

/// From the least to the largest of the values taken.
struct span_of {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void take(double x);
  /// Positive, 1 for a single value: scales divide by it.
  [[nodiscard]] double range() const { return most > least ? most - least : 1.0; }
};

/// A straight scale: numbers onto the page.
struct scale {
  double from, per_unit, at;
  [[nodiscard]] double operator()(double x) const { return at + (x - from) * per_unit; }
};

/// A point on the page, y downwards.
struct spot {
  double x, y;
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

/// An element on a line of its own; `attributes` and `content` are markup.
[[nodiscard]] std::string element(std::string_view name, std::string_view attributes,
                                  std::string_view content = {});
[[nodiscard]] std::string circle(double x, double y, double r, std::string_view attributes,
                                 std::string_view content = {});
[[nodiscard]] std::string rectangle(double x, double y, double width, double height,
                                    std::string_view attributes, std::string_view content = {});
/// Text that may hold markup, such as a raised exponent.
[[nodiscard]] std::string text_markup(double x, double y, std::string_view attributes,
                                      std::string_view markup);

/// A tooltip, as content of an element.
[[nodiscard]] std::string title(std::string_view words);

// `kind` is a class of the picture's style sheet.
[[nodiscard]] std::string text_at(double x, double y, std::string_view kind, std::string_view words);
/// `d` as a path's attribute of that name; no path where it is empty.
[[nodiscard]] std::string path(std::string_view d, std::string_view kind, std::string_view content = {});
[[nodiscard]] std::string line(double x1, double y1, double x2, double y2, std::string_view kind);
/// Ticks and numbers below a picture, without a line.
[[nodiscard]] std::string axis_below(const scale& X, double from, double to, double y);

}  // namespace contct::write::svg
