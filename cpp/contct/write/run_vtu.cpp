#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "contct/path/solve_problem.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/pictures.hpp"

namespace contct::write {
namespace {

constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_quad = 9;

/// The nodes of each element, from 0; of a structure from elsewhere those of its edges.
std::vector<std::vector<int>> elements_of(const model& m) {
  std::vector<std::vector<int>> list;
  if (const auto* a = std::get_if<assembled>(&m.kind))
    for (const mesh_edge& e : a->places.edges) list.push_back({e.from, e.to});
  const auto* const on_plate = std::get_if<plate>(&m.kind);
  for (int e = 0; e < elements(m); ++e) {
    list.push_back({e, e + 1});
    if (on_plate == nullptr) continue;
    const auto corners = on_plate->corners_of(e);
    list.back().assign(corners.begin(), corners.end());
  }
  return list;
}

std::string section(std::string_view name, std::string_view attributes, std::string_view arrays) {
  return fmt::format("      <{0}{1}>\n{2}      </{0}>\n", name, attributes, arrays);
}

/// Numbers at all points, or all cells.
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

/// A pair that has a cell, at a node, and what the cell says.
struct placed_pair {
  int number, node, direction, surface, look;
  double face, gap, force;
};

/// All pairs, but for those of a matrix whose dof has no place.
std::vector<placed_pair> placed_pairs(const problem& p, const frame& f) {
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  std::vector<placed_pair> list;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const contact_pair& of = p.pairs[i];
    const placed_dof at = a == nullptr ? placed_dof{of.node, 3} : a->places.dofs[of.node];
    const pair_reading now = reading_of(p, f, i);
    if (at.node >= 0)
      list.push_back({static_cast<int>(i) + 1, at.node, at.direction, of.surface, static_cast<int>(now.look),
                      of.face, now.gap, now.force});
  }
  return list;
}

/// The places of all points, three numbers each.
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

/// A displacement of a structure from elsewhere.
using in_space = std::array<double, 3>;

/// The dof, from 0, of a node along each axis and about it; -1 where it has none.
struct dofs_of_node {
  std::array<int, 3> along{-1, -1, -1};
  std::array<int, 3> about{-1, -1, -1};

  [[nodiscard]] bool operator==(const dofs_of_node&) const = default;
};

/// Of each node.
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

/// The numbers [dofs] at three dofs; 0 where there is none.
in_space reading_at(const std::array<int, 3>& dofs, const std::vector<double>& numbers) {
  in_space u{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (dofs[axis] >= 0) u[axis] = numbers[dofs[axis]];
  return u;
}

/// The reaction at each dof; 0 where nothing holds it.
std::vector<double> reactions_at_dofs(const problem& p, const frame& f) {
  const load now = load_path(p).at(f.step, f.fraction);
  const std::vector<double> of_support = reactions_in(p, now, f);
  std::vector<double> at(f.displacement.size());
  for (std::size_t i = 0; i < of_support.size(); ++i)
    at[p.supports[i].node * dofs_per_node(p.geometry) + p.supports[i].dof] += of_support[i];
  return at;
}

/// What the points have, and which of it a viewer shows first.
struct point_arrays {
  std::string_view attributes;
  std::string arrays;
};

/// Displacements and reactions, and rotations where there are any.
point_arrays mesh_point_data(const problem& p, const placed_nodes& places, const frame& f) {
  const std::vector<double> reacting = reactions_at_dofs(p, f);
  std::vector<double> displacement;
  std::vector<double> rotation;
  std::vector<double> reaction;
  bool turns = false;
  for (const dofs_of_node& of : dofs_of_nodes(places)) {
    const in_space u = reading_at(of.along, f.displacement);
    const in_space r = reading_at(of.about, f.displacement);
    displacement.insert(displacement.end(), u.begin(), u.end());
    rotation.insert(rotation.end(), r.begin(), r.end());
    const in_space force = reading_at(of.along, reacting);
    reaction.insert(reaction.end(), force.begin(), force.end());
    turns = turns || of.about != dofs_of_node{}.about;
  }
  return {R"( Vectors="displacement")", data_array("displacement", 3, displacement) +
                                            (turns ? data_array("rotation", 3, rotation) : "") +
                                            data_array("reaction", 3, reaction)};
}

point_arrays point_data(const problem& p, const frame& f) {
  if (const auto* a = std::get_if<assembled>(&p.geometry.kind)) return mesh_point_data(p, a->places, f);
  const auto names = dof_names(p.geometry);
  std::vector<double> displacement;
  std::vector<std::vector<double>> by_dof(names.size());
  for (std::size_t i = 0; i < f.displacement.size(); i += names.size()) {
    displacement.insert(displacement.end(), {0.0, 0.0, f.displacement[i]});
    for (std::size_t dof = 0; dof < names.size(); ++dof) by_dof[dof].push_back(f.displacement[i + dof]);
  }
  std::string arrays = data_array("displacement", 3, displacement);
  for (std::size_t dof = 0; dof < names.size(); ++dof) arrays += data_array(names[dof], 1, by_dof[dof]);
  arrays += data_array("reaction", names.size(), reactions_at_dofs(p, f));
  if (!p.beds.empty()) arrays += data_array("pressure", 1, bed_pressure(p, f));
  return {R"( Vectors="displacement" Scalars="w")", std::move(arrays)};
}

/// A column has a number for each element, the same for all, then one for each pair; then comes what the
/// elements read, with zeros for the pairs behind them.
std::string cell_data(const problem& p, const frame& f, std::size_t elements,
                      const std::vector<placed_pair>& pairs) {
  const auto column = [&](const char* name, auto of_elements, auto of_pair) {
    std::vector<decltype(of_elements)> values(elements, of_elements);
    for (const placed_pair& at : pairs) values.push_back(at.*of_pair);
    return data_array(name, 1, values);
  };
  std::string arrays = column("pair", 0, &placed_pair::number) + column("state", -1, &placed_pair::look) +
                       column("surface", 0, &placed_pair::surface) +
                       column("direction", 0, &placed_pair::direction) +
                       column("face", 0.0, &placed_pair::face) + column("gap", 0.0, &placed_pair::gap) +
                       column("force", 0.0, &placed_pair::force);
  const load now = load_path(p).at(f.step, f.fraction);
  const element_results results = elements_in(p, now, f);
  const auto places = static_cast<std::size_t>(results.places);
  for (std::size_t name = 0; name < results.names.size(); ++name) {
    std::vector<double> values;
    for (std::size_t e = 0; e < elements; ++e) {
      const auto at = results.at(e, name);
      values.insert(values.end(), at.begin(), at.end());
    }
    values.resize((elements + pairs.size()) * places);
    arrays += data_array(results.names[name], places, values);
  }
  return arrays;
}

/// The nodes of each cell: elements, then pairs.
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

std::string field_data(const frame& f) {
  const auto one = [](std::string_view name, std::string_view type, auto value) {
    return fmt::format(
        "      <DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
        type, name, value);
  };
  return "    <FieldData>\n" + one("step", "Int32", f.step) + one("increment", "Int32", f.number) +
         one("share", "Float64", f.fraction) + "    </FieldData>\n";
}

/// A file of VTK's, with what is in its one part.
std::string file_of(std::string_view type, std::string_view content) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"{0}\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <{0}>\n{1}  </{0}>\n</VTKFile>\n",
      type, content);
}

}  // namespace

std::string vtu_of_frame(const problem& p, const frame& f) {
  const std::vector<placed_pair> pairs = placed_pairs(p, f);
  std::vector<std::vector<int>> cells = elements_of(p.geometry);
  const std::size_t elements = cells.size();
  for (const placed_pair& at : pairs) cells.push_back({at.node});
  const std::vector<double> points = points_of(p);
  const point_arrays of_points = point_data(p, f);
  return file_of("UnstructuredGrid",
                 field_data(f) +
                     fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                                 points.size() / 3, cells.size()) +
                     section("PointData", of_points.attributes, of_points.arrays) +
                     section("CellData", "", cell_data(p, f, elements, pairs)) +
                     section("Points", "", data_array("points", 3, points)) + cells_of(cells) +
                     "    </Piece>\n");
}

std::string pvd_of_frames(const std::string& stem, std::size_t count) {
  std::string files;
  for (std::size_t i = 0; i < count; ++i)
    files += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", i,
                         markup_text(name_of_frame(stem, i)));
  return file_of("Collection", files);
}

std::string name_of_frame(const std::string& stem, std::size_t number) {
  return fmt::format("{}.{:03}.vtu", stem, number);
}

}  // namespace contct::write
