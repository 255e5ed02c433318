#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "contct/number/decimal.hpp"
#include "contct/read/node_reader.hpp"

namespace contct {
namespace {

/// The largest difference between a coordinate of the mesh in doubles and a decimal that replaces it.
double rounding_of(std::span<const double> among) {
  return 4 * std::numeric_limits<double>::epsilon() *
         std::max(std::abs(among.front()), std::abs(among.back()));
}

int digits_of(const toml_value& named) {
  const written_number* const written = named.written();
  return std::min(written != nullptr ? written->digits : significant_digits(named.found()), most_digits);
}

/// True if the number x of so many digits is the exact place of a node, rounded to these digits or to a
/// double.
bool is_rounded(double x, int digits, const rational& place) {
  constexpr int least_digits = 12;
  return digits >= least_digits && place != 0 &&
         (rounded(place) == x || number_in<double>(rounded_words(place, digits)) == x);
}

/// Minus the number of digits, and the number.
using named_coordinate = std::pair<int, double>;

/// The values of every key x, except that of [beam], and the ends of the pieces of EI or section.
std::vector<named_coordinate> named_coordinates(const toml_value& beam, const toml_value& top) {
  std::vector<named_coordinate> named;
  const auto take = [&named](const toml_value& t, const char* key) {
    if (!t.has(key)) return;
    for (const toml_value& x : t[key].each(any_real.words))
      named.emplace_back(-digits_of(x), x.real(any_real));
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

/// Joins `named` and `ends`, ascending. A coordinate that another one with as many digits or more rounds to
/// is the same node. Omits coordinates outside the ends, which are refused when their tables are read.
std::vector<double> corners_of_mesh(const std::vector<double>& ends, std::vector<named_coordinate> named) {
  std::set<double> corners(ends.begin(), ends.end());
  std::ranges::sort(named);
  for (const auto& [minus_digits, x] : named) {
    if (x < ends.front() || x > ends.back()) continue;
    const auto above = corners.lower_bound(x);
    if (*above != x && !is_rounded(x, -minus_digits, decimal_of(*above)) &&
        !is_rounded(x, -minus_digits, decimal_of(*std::prev(above))))
      corners.insert(above, x);
  }
  return {corners.begin(), corners.end()};
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

std::string coordinate_row::words(std::size_t node) const {
  const rational at = points_.at(node);
  return at == 0 ? "0" : rounded_words(at, most_digits);
}

std::optional<int> coordinate_row::find(const rational& at, double near) const {
  const std::size_t before = points_.point_before(at, near);
  if (points_.at(before) != at) return std::nullopt;
  return static_cast<int>(before);
}

std::optional<int> coordinate_row::find(const toml_value& named) const {
  const double x = named.real(any_real);
  const rational at = decimal_of(x);
  if (const auto found = find(at, x)) return found;
  const std::size_t last = points_.size() - 1;
  const std::size_t before = points_.point_before(at, x);
  const bool is_next = before < last && points_.at(before + 1) - at < at - points_.at(before);
  const std::size_t nearest = before + (is_next ? 1 : 0);
  if (is_even_ && is_rounded(x, digits_of(named), points_.at(nearest))) {
    if (written_number* const written = named.written())
      written->taken_as = fmt::format("; taken as {} {}, at {}", what_, nearest + 1,
                                      short_words(points_.at(nearest), most_digits));
    return static_cast<int>(nearest);
  }
  if (at < points_.at(0) || at > points_.at(last))
    named.refuse(fmt::format("{}, which is outside the structure", x),
                 fmt::format("a number from {} to {}", words(0), words(last)));
  return std::nullopt;
}

line_place coordinate_row::place(std::size_t node) const {
  line_place p(rounded(points_.at(node)));
  if (decimal_of(p.x) != points_.at(node)) p.point = static_cast<int>(node);
  return p;
}

line_place coordinate_row::place_of(const toml_value& named) const {
  const std::optional<int> node = find(named);
  return node ? place(*node) : line_place(named.real(any_real));
}

int coordinate_row::index_of(const toml_value& named) const {
  if (const auto found = find(named)) return *found;
  const double x = named.real(any_real);
  const std::size_t left = points_.point_before(decimal_of(x), x);
  const auto node_words = [this](std::size_t i) {
    return words(i) + (what_ == "node" ? fmt::format(" (node {})", i + 1) : "");
  };
  named.refuse(fmt::format("{}, where there is no {}", x, what_),
               fmt::format("the coordinate of a {}; the nearest are {} and {}; {}", what_, node_words(left),
                           node_words(left + 1), remedy_));
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
