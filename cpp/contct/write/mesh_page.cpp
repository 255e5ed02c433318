#include "contct/write/mesh_page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "contct/write/frame_numbers.hpp"
#include "contct/write/mesh_numbers.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

constexpr double units = 1e5;  // in the largest displacement: a tenth of a pixel is some hundred of them

const assembled& structure_in(const finished_run& r) {
  return std::get<assembled>(r.what.geometry.kind);
}

/// The mesh as the page numbers it.
class shown_mesh {
 public:
  shown_mesh(const finished_run& r, const shown_parts& shown)
      : places_(structure_in(r).places),
        shown_(shown),
        of_node_(dofs_of_nodes(places_)),
        axes_(axes_of(places_)),
        number_(places_.nodes.size(), -1) {
    for (std::size_t i = 0; i < shown.nodes.size(); ++i)
      number_[static_cast<std::size_t>(shown.nodes[i])] = static_cast<int>(i);
  }

  [[nodiscard]] json geometry() const {
    json names = json::array();
    json at[3] = {json::array(), json::array(), json::array()};
    json still = json::array();
    for (std::size_t i = 0; i < shown_.nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(shown_.nodes[i]);
      names.push_back(places_.nodes[node].name);
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis].push_back(places_.nodes[node].at[axis]);
      if (of_node_[node] == dofs_of_node{}) still.push_back(i);
    }
    json edges = json::array();
    for (const int i : shown_.edges) {
      const mesh_edge& e = places_.edges[static_cast<std::size_t>(i)];
      edges.push_back(number_[static_cast<std::size_t>(e.from)]);
      edges.push_back(number_[static_cast<std::size_t>(e.to)]);
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

  [[nodiscard]] json displacements(const frame& f) const {
    json u = json::array();
    for (const int node : shown_.nodes) {
      const in_space at = displacement(node, f);
      for (const int axis : axes_) u.push_back(std::lround(at.at(static_cast<std::size_t>(axis)) / unit()));
    }
    return u;
  }

  /// The loads of a frame that can be drawn, the largest of them.
  [[nodiscard]] json points(const assembled& a, const load& l) const {
    std::vector<point_load> drawn;
    for (const point_load& p : l.points) {
      const placed_dof& at = places_.dofs[static_cast<std::size_t>(p.node)];
      if (at.node >= 0 && number_[static_cast<std::size_t>(at.node)] >= 0 && p.value != 0.0)
        drawn.push_back(p);
    }
    std::stable_sort(drawn.begin(), drawn.end(), [](const point_load& one, const point_load& other) {
      return std::abs(one.value) > std::abs(other.value);
    });
    drawn.resize(std::min(drawn.size(), most_loads));
    json list = json::array();
    for (const point_load& p : drawn) {
      const placed_dof& at = places_.dofs[static_cast<std::size_t>(p.node)];
      list.push_back(
          {number_[static_cast<std::size_t>(at.node)], at.direction, p.node, p.value, a.label_of(p.node)});
    }
    return list;
  }

  void place(int dof, json& entry) const {
    const placed_dof& at = places_.dofs[static_cast<std::size_t>(dof)];
    const int number = at.node < 0 ? -1 : number_[static_cast<std::size_t>(at.node)];
    entry["at"] = number < 0 ? json(nullptr) : json(number);
    entry["direction"] = number < 0 ? 0 : at.direction;
  }

 private:
  [[nodiscard]] in_space displacement(int node, const frame& f) const {
    return reading_at(of_node_[static_cast<std::size_t>(node)].along, f);
  }
  [[nodiscard]] double unit() const { return shown_.reach > 0.0 ? shown_.reach / units : 1.0; }

  [[nodiscard]] static json views_json() {
    json list = json::array();
    for (int i = 0; i < views; ++i) {
      const structure_view& v = view_at(i);
      list.push_back({{"name", v.name}, {"words", v.words}, {"right", v.right}, {"up", v.up}});
    }
    return list;
  }

  const placed_nodes& places_;
  const shown_parts& shown_;
  std::vector<dofs_of_node> of_node_;
  std::vector<int> axes_;
  std::vector<int> number_;  // of a node on the page; -1: it is not there
};

}  // namespace

nlohmann::ordered_json mesh_json(const finished_run& r, const shown_parts& shown) {
  if (!structure_in(r).places.known()) return {{"kind", "none"}};
  return shown_mesh(r, shown).geometry();
}

void add_mesh(const finished_run& r, const load_path& loads, const shown_parts& shown,
              nlohmann::ordered_json& page, nlohmann::ordered_json& frames) {
  const assembled& a = structure_in(r);
  if (!a.places.known()) return;
  const shown_mesh mesh(r, shown);
  for (std::size_t i = 0; i < shown.pairs.size(); ++i)
    mesh.place(r.what.pairs[shown.pairs[i]].node, page["pairs"][i]);
  for (std::size_t i = 0; i < shown.supports.size(); ++i) mesh.place(shown.supports[i], page["supports"][i]);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const frame& f = r.kept.frames()[i];
    frames[i]["u"] = mesh.displacements(f);
    frames[i]["points"] = mesh.points(a, load_of(loads, f));
  }
}

}  // namespace contct
