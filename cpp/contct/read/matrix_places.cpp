#include "contct/read/matrix_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "contct/read/inp_mesh.hpp"
#include "contct/text/input_text.hpp"

namespace contct::read {
namespace {

/// No file of coordinates or of a mesh may be larger, in MiB: a million nodes take some 50.
constexpr std::size_t largest_mesh_file = 256;

/// How many fields stand before a comment.
std::size_t fields_before_comment(const field_lines& lines) {
  std::size_t count = 0;
  while (count < lines.fields() && count < field_lines::most_fields && lines.field(count).front() != '#')
    ++count;
  return count;
}

/// "185" and 3 of "185.3".
placed_dof place_of_label(std::string_view label, const std::unordered_map<std::string_view, int>& nodes) {
  const std::size_t dot = label.rfind('.');
  if (dot == std::string_view::npos) return {};
  const auto node = nodes.find(label.substr(0, dot));
  const int direction = direction_of(label.substr(dot + 1));
  return node == nodes.end() || direction == 0 ? placed_dof{} : placed_dof{node->second, direction};
}

void say_what_is_not_drawn(const assembled& a, placed_nodes& places) {
  std::size_t lost = 0;
  std::size_t turns = 0;
  std::string example;
  for (int dof = 0; dof < a.dofs(); ++dof) {
    const placed_dof& at = places.dofs[dof];
    if (at.node >= 0 && !at.is_length()) ++turns;
    if (at.node < 0 && lost++ == 0) example = a.label_of(dof);
  }
  if (lost > 0)
    places.said.push_back(fmt::format(
        "{} of {} dofs have no known node and direction by their labels, as {}, and are not drawn.", lost,
        a.dofs(), in_quotes(example)));
  if (turns > 0)
    places.said.push_back(fmt::format("Rotations, {} of {} dofs, are not drawn.", turns, a.dofs()));
}

}  // namespace

int direction_of(std::string_view name) {
  constexpr std::string_view names[] = {"x", "y", "z", "rx", "ry", "rz"};
  constexpr std::string_view numbers[] = {"1", "2", "3", "4", "5", "6"};
  for (int i = 0; i < 6; ++i)
    if (name == names[i] || name == numbers[i]) return i + 1;
  return name == "r" ? 6 : 0;
}

std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file) {
  constexpr std::string_view allowed = "name x y, or name x y z";
  field_lines lines(text, file);
  std::vector<placed_node> nodes;
  std::unordered_map<std::string_view, std::int64_t> line_of;  // views of the text
  std::size_t alike = 0;
  while (lines.next()) {
    const std::size_t fields = fields_before_comment(lines);
    if (fields == 0) continue;
    if (fields != 3 && fields != 4) lines.refuse(in_quotes(lines.here()), allowed);
    if (alike == 0) alike = fields;
    if (fields != alike)
      lines.refuse(fmt::format("{} coordinates for node {}", fields - 1, in_quotes(lines.field(0))),
                   fmt::format("{}, as the lines before have", alike - 1));
    const auto [before, is_new] = line_of.try_emplace(lines.field(0), lines.line());
    if (!is_new)
      lines.refuse(fmt::format("node {} again, which line {} has", in_quotes(lines.field(0)), before->second),
                   "each node once");
    nodes.push_back({std::string(lines.field(0)),
                     {lines.real(1, "x"), lines.real(2, "y"), fields == 4 ? lines.real(3, "z") : 0.0}});
  }
  if (nodes.empty()) refuse_line(file, 0, "no node", allowed);
  return nodes;
}

bool place_dofs(const assembled& a, placed_nodes& places) {
  std::unordered_map<std::string_view, int> nodes;
  for (const placed_node& n : places.nodes) nodes.emplace(n.name, static_cast<int>(nodes.size()));
  std::vector<std::array<char, 7>> taken(places.nodes.size());
  bool any = false;
  places.dofs.clear();
  for (int dof = 0; dof < a.dofs(); ++dof) {
    placed_dof at = place_of_label(a.label_of(dof), nodes);
    if (at.node >= 0) {
      char& mark = taken[at.node].at(at.direction);
      if (std::exchange(mark, 1) != 0) at = {};
    }
    any = any || at.node >= 0;
    places.dofs.push_back(at);
  }
  if (any) {
    say_what_is_not_drawn(a, places);
  } else {
    places = {{}, {}, {}, std::move(places.said)};
  }
  return any;
}

void add_coupling_edges(const assembled& a, placed_nodes& places) {
  std::vector<std::pair<int, int>> couples;
  for (const matrix_entry& e : a.stiffness.entries) {
    const int one = places.dofs[e.row].node;
    const int other = places.dofs[e.column].node;
    if (e.value == 0.0 || one < 0 || other < 0 || one == other) continue;
    couples.emplace_back(std::min(one, other), std::max(one, other));
  }
  std::sort(couples.begin(), couples.end());
  couples.erase(std::unique(couples.begin(), couples.end()), couples.end());
  if (couples.size() > most_couplings_of_a_node * places.nodes.size()) {
    places.said.push_back(fmt::format(
        "No edges are drawn, only nodes: the matrix couples {} pairs of its {} nodes, and such couplings are "
        "drawn where there are at most {} for each node, as in frames.",
        couples.size(), places.nodes.size(), most_couplings_of_a_node));
    return;
  }
  for (const auto& [from, to] : couples) places.edges.push_back({from, to, 1});
}

void drop_idle_nodes(placed_nodes& places) {
  std::vector<int> now(places.nodes.size(), -1);
  const auto keep = [&now](int node) {
    if (node >= 0) now[node] = 0;
  };
  for (const placed_dof& d : places.dofs) keep(d.node);
  for (const mesh_edge& e : places.edges) {
    keep(e.from);
    keep(e.to);
  }
  std::vector<placed_node> kept;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] < 0) continue;
    now[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(places.nodes[i]));
  }
  places.nodes = std::move(kept);
  for (placed_dof& d : places.dofs)
    if (d.node >= 0) d.node = now[d.node];
  for (mesh_edge& e : places.edges) {
    e.from = now[e.from];
    e.to = now[e.to];
  }
}

placed_nodes places_from_coordinates(const std::string& path, const assembled& a) {
  placed_nodes places;
  places.nodes = parse_coordinates(read_input(path, "file of coordinates", largest_mesh_file), path);
  if (place_dofs(a, places)) add_coupling_edges(a, places);
  return places;
}

placed_nodes places_from_inp(const std::string& path, const assembled& a) {
  placed_nodes places = parse_inp_mesh(read_input(path, "input file of CalculiX", largest_mesh_file), path);
  if (place_dofs(a, places)) {
    drop_idle_nodes(places);
  } else {
    places.said.push_back(fmt::format("{} has no node of any label, as {}.", path, in_quotes(a.label_of(0))));
  }
  return places;
}

}  // namespace contct::read
