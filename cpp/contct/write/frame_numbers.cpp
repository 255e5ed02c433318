#include "contct/write/frame_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace contct::write {
namespace {

/// How much there is to write: a list of scattered elements counts by its length.
std::size_t parts_of(const load& l) {
  std::size_t parts = l.points.size();
  for (const distributed_load& d : l.distributed)
    parts += d.elements.empty() || is_run(d.elements) ? 1 : d.elements.size();
  return parts;
}

/// A load in words, with its one number apart.
struct load_words {
  std::string before;
  double value;
  std::string after{};
};
load_words words_for(const model& m, const load& l, const resultant& r) {
  const bool of_matrix = std::holds_alternative<assembled>(m.kind);
  if (l.points.size() == 1 && l.distributed.empty()) {
    const point_load& p = l.points[0];
    return {of_matrix ? "" : fmt::format("{} ", dof_names(m)[p.dof]), p.value,
            " at " + place_words(m, p.node)};
  }
  if (l.points.empty() && l.distributed.size() == 1 && l.distributed[0].polynomial.size() == 1)
    return {"uniform ", l.distributed[0].polynomial[0]};
  return {of_matrix ? "sum " : "force ", r.force};
}

}  // namespace

bool is_run(const std::vector<int>& elements) {
  return elements.back() - elements.front() + 1 == static_cast<int>(elements.size()) &&
         std::is_sorted(elements.begin(), elements.end());
}

load_path::load_path(const problem& p) : problem_(p), totals_{resultant_of(p.geometry, {})}, parts_(1) {
  for (const load& l : p.steps) {
    totals_.push_back(resultant_of(p.geometry, l));
    parts_.push_back(parts_of(l));
  }
}

load load_path::at(int step, double fraction) const {
  if (step == 0) return {};
  return mix(step > 1 ? problem_.steps[step - 2] : load{}, problem_.steps[step - 1], fraction);
}

resultant load_path::resultant_at(int step, double fraction) const {
  const resultant& a = totals_[step - 1];
  const resultant& b = totals_[step];
  resultant r{a.force + fraction * (b.force - a.force), a.moments};
  for (std::size_t i = 0; i < r.moments.size(); ++i) r.moments[i] += fraction * (b.moments[i] - a.moments[i]);
  return r;
}

bool load_path::has_many_parts(int step) const {
  constexpr std::size_t most = 32;
  return std::max(parts_[step - 1], parts_[step]) > most;
}

std::string load_path::words_at(int step, double fraction, int width) const {
  const load l = has_many_parts(step) ? load{} : at(step, fraction);
  const load_words w = words_for(problem_.geometry, l, resultant_at(step, fraction));
  const auto fits = [width](const std::string& text) { return static_cast<int>(text.size()) <= width; };
  for (int digits = 6; digits >= 3; --digits) {
    std::string text = fmt::format("{}{:.{}g}{}", w.before, w.value, digits, w.after);
    if (fits(text)) return text;
  }
  std::string number = fmt::format("{:.3g}", w.value);
  return fits(number) ? number : "";
}

double deflection_of(const problem& p, std::span<const double> u, int node) {
  const int dof = node * dofs_per_node(p.geometry);
  return u[dof];
}

pair_reading reading_of(const contact_pair& p, double w, bool closed) {
  return {w, gap_of(p, w, closed), force_of(p, w, closed), look_of(p, w, closed)};
}

pair_reading reading_of(const problem& p, const frame& f, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  return reading_of(at, deflection_of(p, f, at.node), f.closed(pair));
}

void extreme::take(int other_at, double other) {
  if (std::abs(other) > std::abs(value)) *this = {other_at, other};
}

std::vector<int> deflecting_nodes(const problem& p) {
  std::vector<char> is_length(nodes(p.geometry), 1);
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a != nullptr && (a->places.known() || !p.pairs.empty())) {
    for (std::size_t dof = 0; dof < is_length.size(); ++dof)
      is_length[dof] = a->places.known() && a->places.dofs[dof].is_length() ? 1 : 0;
    for (const contact_pair& pair : p.pairs) is_length[pair.node] = 1;
  }
  std::vector<int> list;
  for (int node = 0; node < nodes(p.geometry); ++node)
    if (is_length[node] != 0) list.push_back(node);
  return list;
}

extreme largest_deflection(const problem& p, const frame& f, std::span<const int> among) {
  extreme most{among.empty() ? 0 : among.front()};
  for (const int node : among) most.take(node, deflection_of(p, f, node));
  return most;
}

pair_counts count_pairs(const problem& p, const frame& f) {
  pair_counts n;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) ++n.of(reading_of(p, f, i).look);
  return n;
}

std::string place_name(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? a->label_of(node) : std::to_string(node + 1);
}

place place_of_node(const model& m, int node) {
  if (const auto* b = std::get_if<beam>(&m.kind)) return {b->x[node], 0.0};
  const auto* p = std::get_if<plate>(&m.kind);
  if (p == nullptr) return {static_cast<double>(node), 0.0};
  return {p->x[node % p->columns()], p->y[node / p->columns()]};
}

std::vector<dofs_of_node> dofs_of_nodes(const placed_nodes& places) {
  std::vector<dofs_of_node> list(places.nodes.size());
  for (std::size_t dof = 0; dof < places.dofs.size(); ++dof) {
    const placed_dof& at = places.dofs[dof];
    if (at.node < 0) continue;
    dofs_of_node& of = list[at.node];
    const int axis = (at.direction - 1) % 3;
    (at.is_length() ? of.along : of.about)[axis] = static_cast<int>(dof);
  }
  return list;
}

std::vector<int> axes_of(const placed_nodes& places) {
  std::array<bool, 3> has{};
  for (const placed_dof& d : places.dofs)
    if (d.is_length()) has[d.direction - 1] = true;
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (has[axis]) axes.push_back(axis);
  return axes;
}

in_space reading_at(const std::array<int, 3>& dofs, const frame& f) {
  in_space u{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (dofs[axis] >= 0) u[axis] = f.displacement[dofs[axis]];
  return u;
}

double length_of(const in_space& v) {
  return std::hypot(v[0], v[1], v[2]);
}

int fitting_view(const placed_nodes& places) {
  const std::vector<int> axes = axes_of(places);
  for (const auto& [normal, view] : {std::pair(2, 0), {1, 1}, {0, 2}}) {
    const auto coordinate = [axis = normal](const placed_node& n) { return n.at[axis]; };
    const double first = coordinate(places.nodes.front());
    const bool flat = std::all_of(places.nodes.begin(), places.nodes.end(),
                                  [&](const placed_node& n) { return coordinate(n) == first; });
    if (flat && std::find(axes.begin(), axes.end(), normal) == axes.end()) return view;
  }
  return static_cast<int>(all_views.size()) - 1;
}

}  // namespace contct::write
