#include "contct/read/node_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "contct/number/decimal.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

constexpr const char* point_words = "[x, y], or a list of such points";

/// A key that names places: the structures that have it, and its allowed values if it may name several places
/// by coordinate or label.
struct place_key {
  std::string_view name;
  unsigned structures;
  std::string_view several = {};
};
constexpr place_key place_keys[] = {{"node", beams | plates},
                                    {"nodes", beams | plates},
                                    {"x", beams, "a number, or a list of numbers"},
                                    {"at", plates, point_words},
                                    {"dof", matrices, "a list of labels"},
                                    {"dofs", matrices, "a list of labels"}};

std::vector<coordinate_row> axes_of(const model& m) {
  constexpr std::string_view remedy = "grid lines are set by x and y, or elements, in [plate]";
  if (const auto* b = std::get_if<beam>(&m.kind)) return {nodes_along(*b)};
  if (const auto* p = std::get_if<plate>(&m.kind))
    return {{p->x, p->x_runs, "grid line along x", remedy}, {p->y, p->y_runs, "grid line along y", remedy}};
  return {};
}

int digits_of(const toml_value& named) {
  const written_number* const written = named.written();
  const bool is_literal = written != nullptr && !written->is_whole;  // a whole number may be hexadecimal
  return std::min(is_literal ? significant_digits(written->literal) : significant_digits(named.found()),
                  most_digits);
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

/// The values of every key x, except that of [beam], the ends of beds, and those of pieces.
std::vector<named_coordinate> named_coordinates(const toml_value& beam, const toml_value& top) {
  std::vector<named_coordinate> named;
  const auto take = [&named](const toml_value& t, const char* key) {
    if (!t.has(key)) return;
    for (const toml_value& x : t[key].each(any_real.words))
      named.emplace_back(-digits_of(x), x.real(any_real));
  };
  for (const char* key : {"support", "contact", "bed", "hinge"})
    for (const toml_value& t : top[key].optional_tables()) take(t, "x");
  for (const toml_value& t : top["bed"].optional_tables()) {
    for (const char* key : {"from", "to"}) take(t, key);
    if (has_pieces(t, "modulus"))
      for (const toml_value& piece : t["modulus"].tables()) take(piece, "to");
  }
  for (const char* loads : {"step", "case"})
    for (const toml_value& step : top[loads].optional_tables())
      for (const char* key : {"point", "settlement", "move"})
        for (const toml_value& t : step[key].optional_tables()) take(t, "x");
  std::vector<const char*> in_pieces = {"section"};
  for (const element_key& key : element_keys) in_pieces.push_back(key.name);
  for (const char* const key : in_pieces)
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

/// The decimal with 15 digits nearest to x, if the difference is at most 4 units of the last place of
/// `largest`; otherwise x. A user writes this decimal for the node: 0.2 rather than 0.6 / 3.
double as_written(double x, double largest) {
  const double same = 4 * std::numeric_limits<double>::epsilon() * largest;
  const double decimal = number_in<double>(fmt::format("{:.15g}", x)).value_or(x);
  return std::abs(decimal - x) <= same ? decimal : x;
}

}  // namespace

bool has_pieces(const toml_value& t, std::string_view key) {
  const toml_value value = t[key];
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
  std::vector<double> x;
  x.reserve(elements + std::size_t{1});
  for (int i = 0; i <= elements; ++i) x.push_back(length * i / elements);
  return {std::move(x), std::vector<even_run>{{length, elements}}};
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
  const double largest = std::max(std::abs(ends.front()), std::abs(ends.back()));
  std::vector<double> x = {corners.front()};
  std::vector<even_run> runs;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double left = corners[i - 1];
    const auto count = static_cast<int>(elements_between(i));
    for (int k = 1; k < count; ++k) x.push_back(as_written(left + (corners[i] - left) * k / count, largest));
    x.push_back(corners[i]);
    runs.push_back({corners[i], count});
  }
  return {std::move(x), std::move(runs)};
}

node_reader::node_reader(const model& m)
    : structure_(m), axes_(axes_of(m)), matrix_(std::get_if<assembled>(&m.kind)) {
  if (on_matrix())
    for (const std::string& label : matrix_->labels) dofs_.emplace(label, static_cast<int>(dofs_.size()));
  for (const place_key& key : place_keys)
    if (on(key.structures)) keys_.push_back(key.name);
  for (const char* name : contct::dof_names(m)) dof_names_.emplace_back(name);
}

std::vector<std::string_view> node_reader::keys_with(std::vector<std::string_view> others) const {
  others.insert(others.begin(), keys_.begin(), keys_.end());
  return others;
}

std::string_view node_reader::key_in(const toml_value& t) const {
  std::string_view found;
  for (const std::string_view key : keys_) {
    if (!t.has(key)) continue;
    if (!found.empty()) t.refuse_beside({found}, key, fmt::format("either {} or {}", found, key));
    found = key;
  }
  return found.empty() ? keys_.front() : found;
}

int node_reader::node_at(const toml_value& named) const {
  if (axes_.empty()) return dof_at(named);
  if (axes_.size() == 1) return axes_[0].index_of(named);
  const std::vector<toml_value> point = named.entries(point_words, 2, 2);
  const int i = axes_[0].index_of(point[0]);
  return std::get<plate>(structure_.kind).node_at(i, axes_[1].index_of(point[1]));
}

std::string node_reader::labels_allowed() const {
  const assembled& a = *matrix_;
  return a.labels.empty()
             ? fmt::format(R"(a label, "1" to "{}")", a.dofs())
             : fmt::format("a label of {}, such as {}", a.labels_from, in_quotes(a.labels.front()));
}

int node_reader::dof_at(const toml_value& named) const {
  const std::string label = named.text(labels_allowed());
  if (const auto at = dofs_.find(label); at != dofs_.end()) return at->second;
  // "01" and "+1" are not labels: each dof has one label.
  const int number = label.starts_with('0') ? 0 : number_in<int>(label).value_or(0);
  const bool is_dof = !dofs_.empty() && label.size() > 2 && label[label.size() - 2] == '.' &&
                      label.find_first_not_of("0123456789.") == std::string::npos;
  constexpr const char* no_row =
      ", which has no row: a dof that is fixed or depends on others (*EQUATION, *MPC) has none";
  if (!dofs_.empty() || number < 1 || number > matrix_->dofs())
    named.refuse(in_quotes(label) + (is_dof ? no_row : did_you_mean(label, matrix_->labels)),
                 labels_allowed());
  return number - 1;
}

std::vector<int> node_reader::read(const toml_value& t) const {
  std::vector<int> nodes;
  for (const named_place& place : places(t, false)) nodes.push_back(*place.node);
  return nodes;
}

std::vector<named_place> node_reader::places(const toml_value& t, bool between_nodes) const {
  const bool anywhere = between_nodes && on(beams) && t.has("x");
  if (anywhere) t.refuse_beside({"node", "nodes"}, "x", "either x, or node or nodes");
  const std::string_view key = key_in(t);
  const toml_value named = t[key];
  const int count = nodes(structure_);
  std::vector<named_place> list;
  if (key == "nodes") {
    for (const int node : named.numbers(count)) list.push_back({node});
    return list;
  }
  const std::string allowed = on_matrix()
                                  ? labels_allowed()
                                  : fmt::format("a whole number from 1 to {}; or {} or {} instead of node",
                                                count, keys_[1], keys_[2]);
  const toml::array* const point = named.required(allowed).as_array();
  if (key == "node") return {{named.integer(1, count) - 1}};
  if (key == "at" && point != nullptr && !point->empty() && point->front().is_number())
    return {{node_at(named)}};
  std::set<std::pair<int, double>> seen;
  for (const toml_value& entry : named.each(std::ranges::find(place_keys, key, &place_key::name)->several)) {
    const std::optional<int> node = anywhere ? axes_[0].find(entry) : node_at(entry);
    const double x = node ? 0.0 : entry.real(any_real);
    if (!seen.emplace(node.value_or(-1), x).second)
      entry.refuse(
          node ? place_words(structure_, *node) + ", a second time" : fmt::format("{} a second time", x),
          "each place once");
    list.push_back({node, x});
  }
  return list;
}

std::vector<int> node_reader::labelled(const toml_value& named, std::size_t count) const {
  std::vector<int> list;
  for (const toml_value& entry : named.each("a list of labels")) list.push_back(dof_at(entry));
  if (list.size() != 1 && list.size() != count)
    named.refuse(fmt::format("{} labels", list.size()), fmt::format("1, or {}: one for each pair", count));
  list.resize(count, list.front());
  return list;
}

void node_reader::read_values(const toml_value& t, std::string_view found, const real_range& range,
                              const std::vector<named_place>& at, const taker& take) const {
  if (std::ranges::none_of(dof_names_, [&t](std::string_view name) { return t.has(name); }))
    t.refuse(found, fmt::format("at least one of {}", fmt::join(dof_names_, ", ")));
  for (int dof = 0; dof < static_cast<int>(dof_names_.size()); ++dof) {
    if (!t.has(dof_names_[dof])) continue;
    const toml_value named = t[dof_names_[dof]];
    const double value = named.real(range);
    for (const named_place& place : at) {
      if (place.node) refuse_hinge(named, *place.node, dof);
      take(named, place, dof, value);
    }
  }
}

node_reader::area node_reader::read_area(const toml_value& t) const {
  const auto coordinates = [&](const char* key) {
    return axes_.size() == 1 ? std::vector{t[key]}
                             : t[key].entries("a corner of the rectangle, [x, y]", 2, 2);
  };
  const auto corner = [&](const char* key, bool at_end) {
    const std::vector<toml_value> named = t.has(key) ? coordinates(key) : std::vector<toml_value>();
    std::array<line_place, 2> places{};
    for (std::size_t i = 0; i < axes_.size(); ++i)
      places.at(i) = named.empty() ? axes_[i].place(at_end ? axes_[i].points().size() - 1 : 0)
                                   : axes_[i].place_of(named[i]);
    return places;
  };
  area of{corner("from", false), corner("to", true)};
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (axes_[i].points().place(of.from.at(i)) >= axes_[i].points().place(of.to.at(i)))
      coordinates(t.has("to") ? "to" : "from")[i].refuse(
          fmt::format("{}", of.to.at(i).x),
          fmt::format("more than {}, where this part begins", of.from.at(i).x));
  return of;
}

void node_reader::refuse_hinge(const toml_value& named, int node, int dof) const {
  const auto* const b = std::get_if<beam>(&structure_.kind);
  if (b == nullptr || dof == 0 || !b->has_hinge(node)) return;
  named.refuse(
      fmt::format("theta at node {}, where a hinge has one slope on its left and another on its right",
                  node + 1),
      "w at this node, and theta at a neighbouring node");
}

}  // namespace contct
