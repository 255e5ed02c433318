#include "contct/write/mesh_numbers.hpp"

#include <algorithm>
#include <cmath>

namespace contct {
namespace {

double times(const in_space& a, const in_space& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

constexpr std::array<structure_view, views> all_views = {{
    {"xy", "x to the right, y up", {1, 0, 0}, {0, 1, 0}},
    {"xz", "x to the right, z up", {1, 0, 0}, {0, 0, 1}},
    {"yz", "y to the right, z up", {0, 1, 0}, {0, 0, 1}},
    // The eye is at (3, -6, 3), nearly: right and up are at right angles, and of length 1.
    {"oblique", "oblique, z up", {0.8944, 0.4472, 0}, {-0.1826, 0.3651, 0.9129}},
}};

}  // namespace

std::vector<dofs_of_node> dofs_of_nodes(const placed_nodes& places) {
  std::vector<dofs_of_node> list(places.nodes.size());
  for (std::size_t dof = 0; dof < places.dofs.size(); ++dof) {
    const placed_dof& at = places.dofs[dof];
    if (at.node < 0) continue;
    dofs_of_node& of = list[static_cast<std::size_t>(at.node)];
    const auto axis = static_cast<std::size_t>((at.direction - 1) % 3);
    (at.is_length() ? of.along : of.about).at(axis) = static_cast<int>(dof);
  }
  return list;
}

std::vector<int> axes_of(const placed_nodes& places) {
  std::array<bool, 3> has{};
  for (const placed_dof& d : places.dofs)
    if (d.is_length()) has.at(static_cast<std::size_t>(d.direction - 1)) = true;
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (has.at(static_cast<std::size_t>(axis))) axes.push_back(axis);
  return axes;
}

in_space reading_at(const std::array<int, 3>& dofs, const frame& f) {
  in_space u{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (dofs[axis] >= 0) u[axis] = f.displacement[static_cast<std::size_t>(dofs[axis])];
  return u;
}

double length_of(const in_space& v) {
  return std::hypot(v[0], v[1], v[2]);
}

double structure_view::x_of(const in_space& at) const {
  return times(right, at);
}

double structure_view::y_of(const in_space& at) const {
  return times(up, at);
}

const structure_view& view_at(int number) {
  return all_views.at(static_cast<std::size_t>(number));
}

int fitting_view(const placed_nodes& places) {
  const std::vector<int> axes = axes_of(places);
  for (const auto& [normal, view] : {std::pair(2, 0), {1, 1}, {0, 2}}) {
    const auto coordinate = [axis = static_cast<std::size_t>(normal)](const placed_node& n) {
      return n.at[axis];
    };
    const double first = coordinate(places.nodes.front());
    const bool flat = std::all_of(places.nodes.begin(), places.nodes.end(),
                                  [&](const placed_node& n) { return coordinate(n) == first; });
    if (flat && std::find(axes.begin(), axes.end(), normal) == axes.end()) return view;
  }
  return views - 1;
}

}  // namespace contct
