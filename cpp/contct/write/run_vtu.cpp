#include <fmt/format.h>

#include <cstdint>
#include <type_traits>
#include <utility>

#include "contct/results/quantities.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"

namespace contct {
namespace {

constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_quad = 9;

/// The nodes, from 0, of each element; of a matrix, the nodes of each edge.
std::vector<std::vector<int>> elements_of(const model& m) {
  std::vector<std::vector<int>> list;
  if (const auto* a = std::get_if<assembled>(&m.kind))
    for (const mesh_edge& e : a->places.edges) list.push_back({e.from, e.to});
  for (int e = 0; e < elements(m); ++e) list.push_back(nodes_of_element(m, e));
  return list;
}

std::string section(std::string_view name, std::string_view attributes, std::string_view arrays) {
  return fmt::format("      <{0}{1}>\n{2}      </{0}>\n", name, attributes, arrays);
}

/// An array of numbers at all points or cells, `components` numbers at each.
template <class Number>
std::string data_array(std::string_view name, std::size_t components, const std::vector<Number>& values) {
  constexpr std::string_view type = std::is_same_v<Number, double> ? "Float64"
                                    : std::is_same_v<Number, int>  ? "Int32"
                                                                   : "UInt8";
  return fmt::format(
      "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n        "
      "</DataArray>\n",
      type, markup_text(name), components, fmt::join(values, " "));
}

/// A pair (from 0) that has a cell, the position of its dof, and the node of its other dof (-1: none).
struct pair_cell {
  std::size_t pair;
  placed_dof at;
  int other = -1;
};

/// All pairs, except pairs at a dof of a matrix without a position.
std::vector<pair_cell> pair_cells(const problem& p) {
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  std::vector<pair_cell> list;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const int node = p.pairs[i].node;
    const placed_dof at = a == nullptr ? placed_dof{node, 3} : a->places.dofs[node];
    const int other = p.pairs[i].other;
    if (at.node >= 0) list.push_back({i, at, a == nullptr || other < 0 ? -1 : a->places.dofs[other].node});
  }
  return list;
}

/// The coordinates of all points, three numbers each.
std::vector<double> points_of(const problem& p) {
  std::vector<double> at;
  if (const auto* a = std::get_if<assembled>(&p.geometry.kind)) {
    for (const placed_node& n : a->places.nodes) at.insert(at.end(), n.at.begin(), n.at.end());
  } else {
    for (int node = 0; node < nodes(p.geometry); ++node) {
      const place where = place_of_node(p.geometry, node);
      at.insert(at.end(), {where.x, where.y, 0.0});
    }
  }
  return at;
}

/// The reaction at each dof; 0 at dofs without support.
std::vector<double> reactions_at_dofs(const step_results& r) {
  std::vector<double> at(r.state.displacement.size());
  for (std::size_t i = 0; i < r.reactions.size(); ++i) {
    const support& by = r.what.supports[i];
    at[by.node * dofs_per_node(r.what.geometry) + by.dof] += r.reactions[i];
  }
  return at;
}

/// The arrays at points, and the attributes that name the arrays to show first.
struct point_arrays {
  std::string_view attributes;
  std::string arrays;
};

/// Displacements, reactions and, if there are any, rotations. Components without a dof are 0.
point_arrays mesh_point_data(const placed_nodes& places, const step_results& r) {
  const std::vector<double> reacting = reactions_at_dofs(r);
  std::vector<double> displacement(3 * places.nodes.size());
  std::vector<double> rotation(displacement.size());
  std::vector<double> reaction(displacement.size());
  bool turns = false;
  for (std::size_t dof = 0; dof < places.dofs.size(); ++dof) {
    const placed_dof& at = places.dofs[dof];
    if (at.node < 0) continue;
    const int slot = 3 * at.node + (at.direction - 1) % 3;
    turns = turns || !at.is_length();
    (at.is_length() ? displacement : rotation)[slot] = r.state.displacement[dof];
    if (at.is_length()) reaction[slot] = reacting[dof];
  }
  return {R"( Vectors="displacement")", data_array("displacement", 3, displacement) +
                                            (turns ? data_array("rotation", 3, rotation) : "") +
                                            data_array("reaction", 3, reaction)};
}

point_arrays point_data(const step_results& r) {
  const model& m = r.what.geometry;
  if (const auto* a = std::get_if<assembled>(&m.kind)) return mesh_point_data(a->places, r);
  std::vector<double> displacement;
  for (int node = 0; node < nodes(m); ++node)
    displacement.insert(displacement.end(), {0.0, 0.0, deflection_of(r.what, r.state.displacement, node)});
  std::string arrays = data_array("displacement", 3, displacement);
  for (const auto& [row, values] : columns_of(r, on::nodes)) arrays += data_array(row->key, 1, values);
  arrays += data_array("reaction", dofs_per_node(m), reactions_at_dofs(r));
  return {R"( Vectors="displacement" Scalars="w")", std::move(arrays)};
}

/// The arrays at cells: first elements, then pairs. Arrays about pairs have one constant for all elements;
/// arrays of element results have zeros for pairs.
std::string cell_data(const step_results& r, std::size_t elements, const std::vector<pair_cell>& cells) {
  const auto column = [&](std::string_view name, auto of_elements, auto of_pair) {
    std::vector<decltype(of_elements)> values(elements, of_elements);
    for (const pair_cell& c : cells) values.push_back(of_pair(c));
    return data_array(name, 1, values);
  };
  std::string arrays =
      column("pair", 0, [](const pair_cell& c) { return static_cast<int>(c.pair) + 1; }) +
      column("state", -1, [&](const pair_cell& c) { return static_cast<int>(r.pairs[c.pair].look); }) +
      column("surface", 0, [&](const pair_cell& c) { return r.what.pairs[c.pair].surface; }) +
      column("direction", 0, [](const pair_cell& c) { return c.at.direction; });
  for (const auto& of : columns_of(r, on::pairs))
    arrays += column(of.row->key, 0.0, [&of](const pair_cell& c) { return of.values[c.pair]; });
  for (auto& [row, values] : columns_of(r, on::element_ends)) {
    const std::size_t places = values.size() / elements;
    values.resize((elements + cells.size()) * places);
    arrays += data_array(row->key, places, values);
  }
  return arrays;
}

/// The XML of all cells, from the nodes of each cell, and of the cell types.
std::string cells_of(const std::vector<std::vector<int>>& cells) {
  std::vector<int> connectivity;
  std::vector<int> offsets;
  std::vector<std::uint8_t> types;
  for (const std::vector<int>& at : cells) {
    connectivity.insert(connectivity.end(), at.begin(), at.end());
    offsets.push_back(static_cast<int>(connectivity.size()));
    types.push_back(at.size() == 1 ? vtk_vertex : at.size() == 2 ? vtk_line : vtk_quad);
  }
  return section("Cells", "",
                 data_array("connectivity", 1, connectivity) + data_array("offsets", 1, offsets) +
                     data_array("types", 1, types));
}

std::string field_data(const problem& p, const structure_state& s) {
  const auto one = [](std::string_view name, std::string_view type, auto value) {
    return fmt::format(
        "      <DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
        type, name, value);
  };
  std::string name;
  if (s.step > 0 && p.steps[s.step - 1].from_zero) {  // in VTK, a text is its bytes, then 0
    for (const char c : p.steps[s.step - 1].name) name += fmt::format("{} ", static_cast<unsigned char>(c));
    name = one("name", "String", name + "0");
  }
  return "    <FieldData>\n" + one("step", "Int32", s.step) + one("increment", "Int32", s.number) +
         one("share", "Float64", s.fraction) + name + "    </FieldData>\n";
}

/// A VTK file with one part, which contains `content`.
std::string file_of(std::string_view type, std::string_view content) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"{0}\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <{0}>\n{1}  </{0}>\n</VTKFile>\n",
      type, content);
}

}  // namespace

std::string vtu_of_state(const problem& p, const structure_state& s) {
  const step_results r(p, s);
  const std::vector<pair_cell> pairs = pair_cells(p);
  std::vector<std::vector<int>> cells = elements_of(p.geometry);
  const std::size_t elements = cells.size();
  for (const pair_cell& c : pairs)
    cells.push_back(c.other < 0 ? std::vector{c.at.node} : std::vector{c.at.node, c.other});
  const std::vector<double> points = points_of(p);
  const point_arrays of_points = point_data(r);
  return file_of("UnstructuredGrid",
                 field_data(p, s) +
                     fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                                 points.size() / 3, cells.size()) +
                     section("PointData", of_points.attributes, of_points.arrays) +
                     section("CellData", "", cell_data(r, elements, pairs)) +
                     section("Points", "", data_array("points", 3, points)) + cells_of(cells) +
                     "    </Piece>\n");
}

std::string pvd_of_states(const std::string& stem, std::size_t count) {
  std::string files;
  for (std::size_t i = 0; i < count; ++i)
    files += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", i,
                         markup_text(name_of_state(stem, i)));
  return file_of("Collection", files);
}

std::string name_of_state(const std::string& stem, std::size_t number) {
  return fmt::format("{}.{:03}.vtu", stem, number);
}

}  // namespace contct
