#include "contct/write/run_vtu.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <type_traits>

#include "contct/text/strings.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/load_text.hpp"

namespace contct::write {
namespace {

constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_quad = 9;

/// The nodes of each element, from 0; of a structure from elsewhere those of its edges.
std::vector<std::vector<int>> elements_of(const model& m) {
  std::vector<std::vector<int>> list;
  if (const auto* a = std::get_if<assembled>(&m.kind))
    for (const mesh_edge& e : a->places.edges) list.push_back({e.from, e.to});
  if (const auto* b = std::get_if<beam>(&m.kind)) {
    for (int e = 0; e < b->elements(); ++e) list.push_back({e, e + 1});
  } else if (const auto* p = std::get_if<plate>(&m.kind)) {
    for (int e = 0; e < p->elements(); ++e) {
      const auto corners = p->corners_of(e);
      list.emplace_back(corners.begin(), corners.end());
    }
  }
  return list;
}

template <class Number>
std::string array(std::string_view name, std::size_t components, const std::vector<Number>& values) {
  constexpr std::string_view type = std::is_same_v<Number, double> ? "Float64"
                                    : std::is_same_v<Number, int>  ? "Int32"
                                                                   : "UInt8";
  return fmt::format(
      "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n        "
      "</DataArray>\n",
      type, markup_text(name), components, fmt::join(values, " "));
}

/// The pairs that have a cell, at a node, and the direction in which they act: all, but for those of a matrix
/// whose dof has no place.
struct placed_pair {
  std::size_t pair;
  int node, direction;
};
std::vector<placed_pair> placed_pairs(const problem& p) {
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  std::vector<placed_pair> list;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const int node = p.pairs[i].node;
    const placed_dof at = a == nullptr ? placed_dof{node, 3} : a->places.dofs[node];
    if (at.node >= 0) list.push_back({i, at.node, at.direction});
  }
  return list;
}

std::string points_of(const problem& p) {
  std::vector<double> at;
  if (const auto* a = std::get_if<assembled>(&p.geometry.kind)) {
    for (const placed_node& n : a->places.nodes) at.insert(at.end(), n.at.begin(), n.at.end());
  } else {
    for (int node = 0; node < nodes(p.geometry); ++node) {
      const place where = place_of_node(p.geometry, node);
      at.insert(at.end(), {where.x, where.y, 0.0});
    }
  }
  return "      <Points>\n" + array("points", 3, at) + "      </Points>\n";
}

std::string cells_of(const std::vector<std::vector<int>>& elements, const std::vector<placed_pair>& pairs) {
  std::vector<int> connectivity;
  std::vector<int> offsets;
  std::vector<std::uint8_t> types;
  const auto add = [&](const std::vector<int>& at, std::uint8_t type) {
    connectivity.insert(connectivity.end(), at.begin(), at.end());
    offsets.push_back(static_cast<int>(connectivity.size()));
    types.push_back(type);
  };
  for (const auto& corners : elements) add(corners, corners.size() == 2 ? vtk_line : vtk_quad);
  for (const placed_pair& at : pairs) add({at.node}, vtk_vertex);
  return "      <Cells>\n" + array("connectivity", 1, connectivity) + array("offsets", 1, offsets) +
         array("types", 1, types) + "      </Cells>\n";
}

/// Displacements, and rotations where there are any.
std::string mesh_point_data(const placed_nodes& places, const frame& f) {
  std::vector<double> displacement;
  std::vector<double> rotation;
  bool turns = false;
  for (const dofs_of_node& of : dofs_of_nodes(places)) {
    const in_space u = reading_at(of.along, f);
    const in_space r = reading_at(of.about, f);
    displacement.insert(displacement.end(), u.begin(), u.end());
    rotation.insert(rotation.end(), r.begin(), r.end());
    turns = turns || of.about != dofs_of_node{}.about;
  }
  return "      <PointData Vectors=\"displacement\">\n" + array("displacement", 3, displacement) +
         (turns ? array("rotation", 3, rotation) : "") + "      </PointData>\n";
}

std::string point_data(const problem& p, const frame& f) {
  if (const auto* a = std::get_if<assembled>(&p.geometry.kind)) return mesh_point_data(a->places, f);
  const auto names = dof_names(p.geometry);
  const std::size_t stride = dofs_per_node(p.geometry);
  std::vector<double> displacement;
  std::vector<std::vector<double>> by_dof(names.size());
  for (std::size_t i = 0; i < f.displacement.size(); i += stride) {
    displacement.insert(displacement.end(), {0.0, 0.0, f.displacement[i]});
    for (std::size_t dof = 0; dof < stride; ++dof) by_dof[dof].push_back(f.displacement[i + dof]);
  }
  std::string text =
      "      <PointData Vectors=\"displacement\" Scalars=\"w\">\n" + array("displacement", 3, displacement);
  for (std::size_t dof = 0; dof < stride; ++dof) text += array(names[dof], 1, by_dof[dof]);
  return text + "      </PointData>\n";
}

/// What the elements read, with zeros for the pairs behind them.
std::string element_data(const problem& p, const frame& f, std::size_t elements) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return "";
  const load_path loads(p);
  const element_results results =
      results_in_elements(p.geometry, loads.at(f.step, f.fraction), f.displacement);
  const std::size_t places = results.places;
  std::string text;
  for (std::size_t name = 0; name < results.names.size(); ++name) {
    std::vector<double> values;
    for (std::size_t e = 0; e < elements; ++e) {
      const auto at = results.at(e, name);
      values.insert(values.end(), at.begin(), at.end());
    }
    values.resize((elements + p.pairs.size()) * places);
    text += array(results.names[name], places, values);
  }
  return text;
}

/// A column has a number for each element, the same for all, then one for each pair.
std::string cell_data(const problem& p, const frame& f, std::size_t elements,
                      const std::vector<placed_pair>& pairs) {
  const auto column = [&](std::string_view name, auto of_elements, auto of_pair) {
    std::vector<decltype(of_elements)> values(elements, of_elements);
    for (const placed_pair& at : pairs) values.push_back(of_pair(at.pair));
    return array(name, 1, values);
  };
  std::string text = "      <CellData>\n";
  text += column("pair", 0, [](std::size_t i) { return static_cast<int>(i) + 1; });
  text += column("state", -1, [&](std::size_t i) { return static_cast<int>(reading_of(p, f, i).look); });
  text += column("surface", 0, [&](std::size_t i) { return p.pairs[i].surface; });
  std::vector<int> direction(elements, 0);
  for (const placed_pair& at : pairs) direction.push_back(at.direction);
  text += array("direction", 1, direction);
  text += column("face", 0.0, [&](std::size_t i) { return p.pairs[i].face; });
  text += column("gap", 0.0, [&](std::size_t i) { return reading_of(p, f, i).gap; });
  text += column("force", 0.0, [&](std::size_t i) { return reading_of(p, f, i).force; });
  return text + element_data(p, f, elements) + "      </CellData>\n";
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

constexpr std::string_view head =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"LittleEndian\">\n";

}  // namespace

std::string vtu_of_frame(const problem& p, const frame& f) {
  const auto elements = elements_of(p.geometry);
  const auto pairs = placed_pairs(p);
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  const auto points = a != nullptr ? std::ssize(a->places.nodes) : nodes(p.geometry);
  return fmt::format(fmt::runtime(head), "UnstructuredGrid") + "  <UnstructuredGrid>\n" + field_data(f) +
         fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points,
                     elements.size() + pairs.size()) +
         point_data(p, f) + cell_data(p, f, elements.size(), pairs) + points_of(p) +
         cells_of(elements, pairs) + "    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

std::string pvd_of_frames(const std::string& stem, std::size_t count) {
  std::string text = fmt::format(fmt::runtime(head), "Collection") + "  <Collection>\n";
  for (std::size_t i = 0; i < count; ++i) {
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", i,
                        markup_text(name_of_frame(stem, i)));
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

std::string name_of_frame(const std::string& stem, std::size_t number) {
  return fmt::format("{}.{:03}.vtu", stem, number);
}

}  // namespace contct::write
