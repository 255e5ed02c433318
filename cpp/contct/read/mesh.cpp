#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/read/node_reader.hpp"

namespace contct {
namespace {

/// The largest difference at which two coordinates count as equal decimals.
double rounding_of(std::span<const double> among) {
  return 4 * std::numeric_limits<double>::epsilon() *
         std::max(std::abs(among.front()), std::abs(among.back()));
}

/// The values of every key x, except that of [beam], and the ends of the pieces of EI or section.
std::vector<double> named_coordinates(const toml_value& beam, const toml_value& top) {
  std::vector<double> named;
  const auto take = [&named](const toml_value& t, const char* key) {
    if (!t.has(key)) return;
    for (const toml_value& x : t[key].each(any_real.words)) named.push_back(x.real(any_real));
  };
  for (const char* key : {"support", "contact", "bed", "hinge"})
    for (const toml_value& t : top[key].optional_tables()) take(t, "x");
  for (const char* loads : {"step", "case"})
    for (const toml_value& step : top[loads].optional_tables())
      for (const char* key : {"point", "settlement", "move"})
        for (const toml_value& t : step[key].optional_tables()) take(t, "x");
  for (const char* key : {"EI", "section"})
    if (has_pieces(beam, key))
      for (const toml_value& piece : beam[key].tables()) take(piece, "to");
  return named;
}

/// Joins `named` and `ends`, ascending, each coordinate once. Omits coordinates outside the ends, which are
/// refused when their tables are read.
std::vector<double> corners_of_mesh(const std::vector<double>& ends, std::vector<double> named) {
  std::erase_if(named, [&ends](double x) {
    return x < ends.front() || x > ends.back() || find_coordinate(ends, x).has_value();
  });
  std::ranges::sort(named);
  const double same = rounding_of(ends);
  named.erase(std::unique(named.begin(), named.end(), [same](double a, double b) { return b - a <= same; }),
              named.end());
  named.insert(named.end(), ends.begin(), ends.end());
  std::ranges::sort(named);
  return named;
}

/// The decimal with 15 digits nearest to x, if the difference is at most `same`; otherwise x. A user writes
/// this decimal for the node: 0.2 rather than 0.6 / 3.
double as_written(double x, double same) {
  const double decimal = number_in<double>(fmt::format("{:.15g}", x)).value_or(x);
  return std::abs(decimal - x) <= same ? decimal : x;
}

}  // namespace

bool has_pieces(const toml_value& beam, std::string_view key) {
  const toml_value value = beam[key];
  if (!value.is_array()) return false;
  const toml::array& pieces = *value.required("").as_array();
  return !pieces.empty() && pieces.front().is_table();
}

std::optional<int> find_coordinate(std::span<const double> among, double x) {
  const auto above = std::ranges::lower_bound(among, x);
  std::ptrdiff_t nearest = above - among.begin();
  if (above == among.end() || (nearest > 0 && x - among[nearest - 1] < among[nearest] - x)) --nearest;
  if (std::abs(among[nearest] - x) > rounding_of(among)) return std::nullopt;
  return static_cast<int>(nearest);
}

void coordinate_row::refuse_outside(const toml_value& named, double x) const {
  if (x < values.front() || x > values.back())
    named.refuse(fmt::format("{}, which is outside the structure", x),
                 fmt::format("a number from {} to {}", values.front(), values.back()));
}

double coordinate_row::place_of(const toml_value& named) const {
  const double x = named.real(any_real);
  if (const auto found = find_coordinate(values, x)) return values[*found];
  refuse_outside(named, x);
  return x;
}

int coordinate_row::index_of(const toml_value& named) const {
  const double x = named.real(any_real);
  if (const auto found = find_coordinate(values, x)) return *found;
  refuse_outside(named, x);
  const std::ptrdiff_t right = std::ranges::lower_bound(values, x) - values.begin();
  const auto words = [this](std::ptrdiff_t i) {
    return fmt::format("{:.12g}", values[i]) + (what == "node" ? fmt::format(" (node {})", i + 1) : "");
  };
  named.refuse(fmt::format("{}, where there is no {}", x, what),
               fmt::format("the coordinate of a {}; the nearest are {} and {}; {}", what, words(right - 1),
                           words(right), remedy));
}

mesh_line even_line(double length, int elements) {
  mesh_line line{{}, {{length, elements}}};
  line.x.reserve(elements + std::size_t{1});
  for (int i = 0; i <= elements; ++i) line.x.push_back(length * i / elements);
  return line;
}

mesh_line sized_mesh(const toml_value& beam, const toml_value& top, const std::vector<double>& ends) {
  const toml_value element_size = beam["element_size"];
  const double size = element_size.real(positive_real);
  const std::vector<double> corners = corners_of_mesh(ends, named_coordinates(beam, top));
  // Rounding must not add an element: 2.1 / 0.7 is rounded to more than 3.
  const auto elements_between = [&](std::size_t i) {
    return std::max(1.0, std::ceil((corners[i] - corners[i - 1]) / size - 1e-9));
  };
  double elements = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) elements += elements_between(i);
  if (elements > most_elements)
    element_size.refuse(fmt::format("{:g}, which makes {:.10g} elements", size, elements),
                        fmt::format("a length that makes at most {} elements", most_elements));
  const double same = rounding_of(ends);
  mesh_line line{{corners.front()}, {}};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double left = corners[i - 1];
    const auto count = static_cast<int>(elements_between(i));
    for (int k = 1; k < count; ++k)
      line.x.push_back(as_written(left + (corners[i] - left) * k / count, same));
    line.x.push_back(corners[i]);
    line.runs.push_back({corners[i], count});
  }
  return line;
}

}  // namespace contct
