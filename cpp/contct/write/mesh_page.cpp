#include "contct/write/mesh_page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

constexpr double units = 1e5;  // in the largest displacement: a tenth of a pixel is some hundred of them

json views_json() {
  json list = json::array();
  for (int i = 0; i < views; ++i) {
    const structure_view& v = view_at(i);
    list.push_back({{"name", v.name}, {"words", v.words}, {"right", v.right}, {"up", v.up}});
  }
  return list;
}

}  // namespace

mesh_page::mesh_page(const assembled& a, const shown_parts& shown)
    : structure_(a),
      places_(a.places),
      shown_(shown),
      of_node_(dofs_of_nodes(places_)),
      axes_(axes_of(places_)),
      number_(places_.nodes.size(), -1) {
  for (int i = 0; const int node : shown.nodes) number_[node] = i++;
}

json mesh_page::geometry() const {
  json names = json::array();
  json at[3] = {json::array(), json::array(), json::array()};
  json still = json::array();
  for (const int node : shown_.nodes) {
    names.push_back(places_.nodes[node].name);
    for (int axis = 0; axis < 3; ++axis) at[axis].push_back(places_.nodes[node].at[axis]);
    if (of_node_[node] == dofs_of_node{}) still.push_back(number_[node]);
  }
  json edges = json::array();
  for (const int i : shown_.edges) {
    edges.push_back(number_[places_.edges[i].from]);
    edges.push_back(number_[places_.edges[i].to]);
  }
  return {{"kind", "mesh"},
          {"all_nodes", places_.nodes.size()},
          {"all_edges", places_.edges.size()},
          {"names", std::move(names)},
          {"x", std::move(at[0])},
          {"y", std::move(at[1])},
          {"z", std::move(at[2])},
          {"edges", std::move(edges)},
          {"axes", axes_},
          {"unit", unit()},
          {"reach", shown_.reach},
          {"still", std::move(still)},
          {"views", views_json()},
          {"view", fitting_view(places_)}};
}

json mesh_page::displacements(const frame& f) const {
  json u = json::array();
  for (const int node : shown_.nodes) {
    const in_space at = reading_at(of_node_[node].along, f);
    for (const int axis : axes_) u.push_back(std::lround(at[axis] / unit()));
  }
  return u;
}

json mesh_page::points(const load& l) const {
  std::vector<point_load> drawn;
  std::copy_if(l.points.begin(), l.points.end(), std::back_inserter(drawn),
               [this](const point_load& p) { return node_of(p.node) >= 0 && p.value != 0.0; });
  json list = json::array();
  for (const point_load& p : largest_loads(std::move(drawn)))
    list.push_back(
        {node_of(p.node), places_.dofs[p.node].direction, p.node, p.value, structure_.label_of(p.node)});
  return list;
}

void mesh_page::place(int dof, json& entry) const {
  const int node = node_of(dof);
  entry["at"] = node < 0 ? json(nullptr) : json(node);
  entry["direction"] = node < 0 ? 0 : places_.dofs[dof].direction;
}

int mesh_page::node_of(int dof) const {
  const int node = places_.dofs[dof].node;
  return node < 0 ? -1 : number_[node];
}

double mesh_page::unit() const {
  return shown_.reach > 0.0 ? shown_.reach / units : 1.0;
}

}  // namespace contct::write
