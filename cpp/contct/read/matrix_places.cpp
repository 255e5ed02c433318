#include "contct/read/matrix_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include "contct/read/matrix_files.hpp"
#include "contct/text/input_text.hpp"

namespace contct::read {
namespace {

/// No file of coordinates or of a mesh may be larger, in MiB: a million nodes take some 50.
constexpr std::size_t largest_mesh_file = 256;

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

constexpr int any_number = std::numeric_limits<int>::max();

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(blanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

/// CalculiX ignores case and blanks in a keyword's line.
std::string without_case_and_blanks(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if (blanks.find(c) != std::string_view::npos) continue;
    plain += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return plain;
}

/// The lines of an input file without blank lines and comments: keywords, and the lines of data behind each.
class inp_lines : public text_lines {
 public:
  using text_lines::text_lines;

  /// Go to the next keyword, past any data; false where there is none.
  bool next_keyword() {
    while (!std::exchange(at_new_keyword_, false)) {
      if (!next()) return false;
      at_new_keyword_ = data_.front() == '*';
    }
    return true;
  }

  /// Go to the next line of data of this keyword; false where there is none.
  bool next_data() {
    if (at_new_keyword_ || !next()) return false;
    at_new_keyword_ = data_.front() == '*';
    return !at_new_keyword_;
  }

  /// The line without the blanks around it.
  [[nodiscard]] std::string_view data() const { return data_; }

  /// The fields between the line's commas; one that is empty at the end does not count.
  [[nodiscard]] const std::vector<std::string_view>& fields() {
    fields_.clear();
    std::string_view left = data_;
    for (;;) {
      const std::size_t comma = left.find(',');
      fields_.push_back(trimmed(left.substr(0, comma)));
      if (comma == std::string_view::npos) break;
      left.remove_prefix(comma + 1);
    }
    if (fields_.size() > 1 && fields_.back().empty()) fields_.pop_back();
    return fields_;
  }

 private:
  bool next() {
    do {
      if (!text_lines::next()) return false;
      data_ = trimmed(here());
      if (data_.find('\0') != std::string_view::npos) refuse("a byte of 0", "text: is it a binary file?");
    } while (data_.empty() || data_.starts_with("**"));
    if (data_.front() != '*') refuse_unended();
    return true;
  }

  std::string_view data_;
  bool at_new_keyword_ = false;
  std::vector<std::string_view> fields_;
};

/// The edges of a solid between its corners, from 0. Midside nodes, if any, follow the corners in the order
/// of the edges.
struct solid {
  std::string_view type;
  std::size_t corners;
  bool midside_nodes;
  std::span<const std::pair<int, int>> edges;

  [[nodiscard]] std::size_t nodes() const { return corners + (midside_nodes ? edges.size() : 0); }
};

constexpr std::pair<int, int> tetrahedron[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
constexpr std::pair<int, int> wedge[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                         {5, 3}, {0, 3}, {1, 4}, {2, 5}};
constexpr std::pair<int, int> brick[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                         {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr solid known_solids[] = {{"C3D4", 4, false, tetrahedron}, {"C3D6", 6, false, wedge},
                                  {"C3D8", 8, false, brick},       {"C3D10", 4, true, tetrahedron},
                                  {"C3D15", 6, true, wedge},       {"C3D20", 8, true, brick}};

/// The solid that a type names, with any letters behind it; null where it is another.
const solid* solid_of(std::string_view type) {
  for (const solid& s : known_solids) {
    if (type.substr(0, s.type.size()) != s.type) continue;
    const std::string_view letters = type.substr(s.type.size());
    if (std::all_of(letters.begin(), letters.end(), [](char c) { return c >= 'A' && c <= 'Z'; })) return &s;
  }
  return nullptr;
}

/// The elements of one *ELEMENT.
struct solid_block {
  const solid* type;
  std::vector<int> nodes;           // the numbers, of one element after the other
  std::vector<std::int64_t> lines;  // where each element begins
};

/// Nodes in the order of the file, and their indices by number.
struct node_list {
  std::vector<placed_node> nodes;
  std::unordered_map<int, int> index;
};

void read_nodes(inp_lines& lines, node_list& list) {
  while (lines.next_data()) {
    const std::vector<std::string_view>& fields = lines.fields();
    const int number = lines.whole(fields[0], 1, any_number, "the node's number");
    if (fields.size() < 2) lines.refuse(field_words(lines.data(), "a line"), "number, x, y, z");
    placed_node node{std::to_string(number), {}};
    // As CalculiX has it: a coordinate that is left out is 0.
    for (std::size_t i = 0; i < 3 && i + 1 < fields.size(); ++i)
      node.at[i] = fields[i + 1].empty() ? 0.0 : lines.real(fields[i + 1], "a coordinate", true);
    const auto [before, is_new] = list.index.try_emplace(number, static_cast<int>(list.nodes.size()));
    if (is_new) {
      list.nodes.push_back(std::move(node));
    } else if (list.nodes[before->second].at != node.at) {
      lines.refuse(fmt::format("node {} again, at another place", number), "each node at one place");
    }
  }
}

/// An element's nodes may stand on several lines; its type says how many there are.
solid_block read_solids(inp_lines& lines, const solid& type) {
  solid_block block{&type, {}, {}};
  const auto whole_elements = [&] { return block.nodes.size() % type.nodes() == 0; };
  while (lines.next_data()) {
    const std::vector<std::string_view>& fields = lines.fields();
    const std::size_t first = whole_elements() ? 1 : 0;
    if (first == 1) {
      (void)lines.whole(fields[0], 1, any_number, "the element's number");
      block.lines.resize(block.nodes.size() / type.nodes());
      block.lines.push_back(lines.line());
    }
    for (std::size_t i = first; i < fields.size(); ++i) {
      if (i > first && whole_elements())
        lines.refuse(field_words(lines.data(), "a line"),
                     fmt::format("{} nodes for an element of type {}", type.nodes(), type.type));
      block.nodes.push_back(lines.whole(fields[i], 1, any_number, "a node's number"));
    }
  }
  if (!whole_elements())
    refuse_line(lines.file(), block.lines.back(),
                fmt::format("an element with {} nodes", block.nodes.size() % type.nodes()),
                fmt::format("{} nodes for type {}", type.nodes(), type.type));
  return block;
}

/// Of other types only this is known: a comma at a line's end continues it.
int count_elements(inp_lines& lines) {
  int count = 0;
  bool continues = false;
  while (lines.next_data()) {
    if (!continues) ++count;
    continues = lines.data().back() == ',';
  }
  return count;
}

/// The TYPE of an *ELEMENT line without case and blanks.
std::string type_in(const inp_lines& lines, const std::string& keyword_line) {
  const std::string parameter = ",TYPE=";
  const std::size_t at = keyword_line.find(parameter);
  const std::size_t from = at + parameter.size();
  std::string type =
      at == std::string::npos ? "" : keyword_line.substr(from, keyword_line.find(',', from) - from);
  if (type.empty()) lines.refuse("*ELEMENT without TYPE", "*ELEMENT, TYPE=..., as C3D8");
  return type;
}

/// What an input file holds. Nodes may stand behind the elements that name them.
struct inp_contents {
  node_list nodes;
  std::vector<solid_block> solids;
  std::map<std::string, int> other_elements;  // how many of each type whose edges are not known
  bool includes = false;
};

inp_contents read_contents(inp_lines& lines) {
  inp_contents all;
  while (lines.next_keyword()) {
    const std::string line = without_case_and_blanks(lines.data());
    const std::string keyword = line.substr(0, line.find(','));
    if (keyword == "*INCLUDE") all.includes = true;
    if (keyword == "*NODE") read_nodes(lines, all.nodes);
    if (keyword != "*ELEMENT") continue;
    const std::string type = type_in(lines, line);
    if (const solid* const known = solid_of(type)) {
      all.solids.push_back(read_solids(lines, *known));
    } else if (const int count = count_elements(lines); count > 0) {
      all.other_elements[type] += count;
    }
  }
  return all;
}

/// Each edge once, with the number of elements that have it. Linear but for a sort.
std::vector<mesh_edge> edges_of(const inp_contents& all, const std::string& file) {
  std::vector<std::pair<int, int>> pairs;
  const auto append = [&pairs](int from, int to) {
    if (from != to) pairs.emplace_back(std::min(from, to), std::max(from, to));
  };
  for (const solid_block& block : all.solids) {
    const solid& type = *block.type;
    for (std::size_t e = 0; e * type.nodes() < block.nodes.size(); ++e) {
      const auto index = [&](std::size_t i) {
        const int number = block.nodes[e * type.nodes() + i];
        const auto at = all.nodes.index.find(number);
        if (at == all.nodes.index.end())
          refuse_line(file, block.lines[e], fmt::format("node {} in an element", number),
                      all.includes ? "nodes that *NODE has in this file: *INCLUDE is not followed"
                                   : "nodes that *NODE has");
        return at->second;
      };
      for (std::size_t k = 0; k < type.edges.size(); ++k) {
        const int from = index(type.edges[k].first);
        const int to = index(type.edges[k].second);
        const int middle = type.midside_nodes ? index(type.corners + k) : to;
        append(from, middle);
        append(middle, to);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<mesh_edge> edges;
  for (const auto& [from, to] : pairs) {
    if (edges.empty() || edges.back().from != from || edges.back().to != to) edges.push_back({from, to, 0});
    ++edges.back().elements;
  }
  return edges;
}

std::vector<std::string> what_is_left_out(const inp_contents& all, const std::string& file) {
  std::vector<std::string> said;
  if (all.includes)
    said.push_back(fmt::format("*INCLUDE in {} is not followed: what such files hold is not drawn.", file));
  std::string types;
  for (const auto& [type, number] : all.other_elements)
    types += fmt::format("{}{} of type {}", types.empty() ? "" : ", ", number, in_quotes(type));
  if (!types.empty())
    said.push_back(fmt::format("Of {}, elements whose edges are not known are not drawn: {}.", file, types));
  return said;
}

}  // namespace

int direction_of(std::string_view name) {
  constexpr std::string_view names[] = {"x", "y", "z", "rx", "ry", "rz"};
  constexpr std::string_view numbers[] = {"1", "2", "3", "4", "5", "6"};
  for (int i = 0; i < 6; ++i)
    if (name == names[i] || name == numbers[i]) return i + 1;
  return name == "r" ? 6 : 0;
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

/// The pairs of nodes that entries couple, each once, ascending.
std::vector<std::pair<int, int>> couples_of(const std::vector<matrix_entry>& entries,
                                            const placed_nodes& places) {
  std::vector<std::pair<int, int>> couples;
  for (const matrix_entry& e : entries) {
    const int one = places.dofs[e.row].node;
    const int other = places.dofs[e.column].node;
    if (e.value == 0.0 || one < 0 || other < 0 || one == other) continue;
    couples.emplace_back(std::min(one, other), std::max(one, other));
  }
  std::sort(couples.begin(), couples.end());
  couples.erase(std::unique(couples.begin(), couples.end()), couples.end());
  return couples;
}

void add_coupling_edges(const assembled& a, placed_nodes& places) {
  const std::vector<std::pair<int, int>> couples = couples_of(a.stiffness.entries, places);
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
  for (const placed_dof& d : places.dofs)
    if (d.node >= 0) now[d.node] = 0;
  for (const mesh_edge& e : places.edges) now[e.from] = now[e.to] = 0;
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

placed_nodes parse_inp_mesh(std::string_view text, std::string_view file) {
  inp_lines lines(text, file);
  inp_contents all = read_contents(lines);
  placed_nodes mesh;
  mesh.edges = edges_of(all, lines.file());
  mesh.said = what_is_left_out(all, lines.file());
  mesh.nodes = std::move(all.nodes.nodes);
  return mesh;
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
