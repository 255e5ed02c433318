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

namespace contct {
namespace {

constexpr int any_number = std::numeric_limits<int>::max();

/// The direction that the last part of a label names: x, y, z or 1, 2, 3 give 1 to 3; rx, ry, rz or 4, 5, 6
/// give 4 to 6; r, the rotation of a plane structure, gives 6; any other text gives 0.
int direction_of(std::string_view name) {
  constexpr std::string_view names[] = {"x", "y", "z", "rx", "ry", "rz"};
  for (int i = 0; i < 6; ++i)
    if (name == names[i] || name == std::to_string(i + 1)) return i + 1;
  return name == "r" ? 6 : 0;
}

/// Finds node "185" and direction 3 in the label "185.3"; empty if the node or the direction is unknown.
placed_dof place_of_label(std::string_view label, const std::unordered_map<std::string_view, int>& nodes) {
  const std::size_t dot = label.rfind('.');
  if (dot == std::string_view::npos) return {};
  const auto node = nodes.find(label.substr(0, dot));
  const int direction = direction_of(label.substr(dot + 1));
  return node == nodes.end() || direction == 0 ? placed_dof{} : placed_dof{node->second, direction};
}

void say_what_is_not_drawn(const assembled& a, placed_nodes& places) {
  const auto lost = std::ranges::count(places.dofs, -1, &placed_dof::node);
  const auto first = std::ranges::find(places.dofs, -1, &placed_dof::node) - places.dofs.begin();
  if (lost > 0)
    places.notes.push_back(fmt::format(
        "{} of {} dofs are not drawn: their labels, such as {}, name no known node and direction.", lost,
        a.dofs(), in_quotes(a.label_of(static_cast<int>(first)))));
  const auto lengths = std::ranges::count_if(places.dofs, &placed_dof::is_length);
  if (const auto turns = a.dofs() - lost - lengths; turns > 0)
    places.notes.push_back(fmt::format("Rotations ({} of {} dofs) are not drawn.", turns, a.dofs()));
}

/// Finds the node of each dof by its label. If two labels name the same node and direction, ignores the
/// second. False if no label names a node; then no position is known.
bool place_dofs(const assembled& a, placed_nodes& places) {
  std::unordered_map<std::string_view, int> nodes;
  for (const placed_node& n : places.nodes) nodes.emplace(n.name, static_cast<int>(nodes.size()));
  std::vector<std::array<char, 7>> taken(places.nodes.size());
  for (int dof = 0; dof < a.dofs(); ++dof) {
    placed_dof at = place_of_label(a.label_of(dof), nodes);
    if (at.node >= 0 && std::exchange(taken[at.node].at(at.direction), 1) != 0) at = {};
    places.dofs.push_back(at);
  }
  const bool any = std::ranges::any_of(places.dofs, [](const placed_dof& at) { return at.node >= 0; });
  if (any)
    say_what_is_not_drawn(a, places);
  else
    places = {{}, {}, {}, std::move(places.notes)};
  return any;
}

/// Makes one edge of all equal node pairs in `pairs`; the edge's `elements` is the number of these pairs.
std::vector<mesh_edge> edges_of(std::vector<std::pair<int, int>> pairs) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<mesh_edge> edges;
  for (const auto& [from, to] : pairs) {
    if (edges.empty() || edges.back().from != from || edges.back().to != to) edges.push_back({from, to, 0});
    ++edges.back().elements;
  }
  return edges;
}

/// Adds an edge between any two nodes that the matrix couples; none if there are more than 3 edges for each
/// node, as in a solid or a plate, whose couplings are not members. A frame has at most 3.
void add_coupling_edges(const assembled& a, placed_nodes& places) {
  constexpr std::size_t most_couplings_of_a_node = 3;
  std::vector<std::pair<int, int>> couples;
  for (const matrix_entry& e : a.stiffness.entries) {
    const auto [from, to] = std::minmax({places.dofs[e.row].node, places.dofs[e.column].node});
    if (e.value != 0.0 && from >= 0 && from != to) couples.emplace_back(from, to);
  }
  places.edges = edges_of(std::move(couples));
  for (mesh_edge& e : places.edges) e.elements = 1;
  if (places.edges.size() <= most_couplings_of_a_node * places.nodes.size()) return;
  places.notes.push_back(fmt::format(
      "Only nodes are drawn, no edges: the matrix couples {} pairs of its {} nodes. Couplings are drawn as "
      "edges if there are at most {} for each node, as in frames.",
      places.edges.size(), places.nodes.size(), most_couplings_of_a_node));
  places.edges.clear();
}

/// Removes the nodes that have neither a dof nor an edge.
void drop_idle_nodes(placed_nodes& places) {
  std::vector<int*> uses;
  for (placed_dof& d : places.dofs)
    if (d.node >= 0) uses.push_back(&d.node);
  for (mesh_edge& e : places.edges) uses.insert(uses.end(), {&e.from, &e.to});
  std::vector<int> now(places.nodes.size(), -1);  // [nodes] the node's new number; -1: idle
  for (const int* const node : uses) now[*node] = 0;
  int kept = 0;
  for (int& number : now)
    if (number == 0) number = kept++;
  // erase_if calls the predicate for each node at its old place.
  std::erase_if(places.nodes, [&](const placed_node& n) { return now[&n - places.nodes.data()] < 0; });
  for (int* const node : uses) *node = now[*node];
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// The fields between the commas of a line, without an empty last field.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t from = 0, end = 0; end < line.size(); from = end + 1) {
    end = std::min(line.find(',', from), line.size());
    fields.push_back(trimmed(line.substr(from, end - from)));
  }
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

/// In upper case and without blanks, because CalculiX ignores case and blanks in the line of a keyword.
std::string without_case_and_blanks(std::string_view text) {
  std::string plain(text);
  std::erase_if(plain, [](char c) { return blanks.find(c) != std::string_view::npos; });
  for (char& c : plain)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return plain;
}

/// A type of solid element. `edges`: pairs of corners, from 0. Midside nodes, if any, follow the corners in
/// the order of the edges.
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

/// The solid of an element type, which may have letters after the number; null for other types.
const solid* solid_of(std::string_view type) {
  const auto* const found = std::ranges::find_if(known_solids, [type](const solid& s) {
    return type.starts_with(s.type) &&
           type.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ", s.type.size()) == std::string::npos;
  });
  return found == std::end(known_solids) ? nullptr : found;
}

/// Reads an input file of CalculiX. Nodes may come after the elements that name them.
class inp_reader {
 public:
  inp_reader(std::string_view text, std::string_view file) : lines_(text, file) {}

  placed_nodes read() {
    while (next_line()) {
      if (line_.front() == '*') {
        end_block();
        begin_block();
      } else if (holds_ == data::nodes) {
        read_node();
      } else if (holds_ == data::solids) {
        read_solid();
      } else if (holds_ == data::others) {
        if (!std::exchange(continues_, line_.back() == ',')) ++others_[type_];
      }
    }
    end_block();
    return {std::move(nodes_), edges_of(indexed_sides()), {}, left_out()};
  }

 private:
  enum class data { ignored, nodes, solids, others };

  /// An edge, or half of an edge with a midside node. `from` and `to` are node numbers of the file.
  struct side {
    int from, to;
    std::int64_t line_of_element;
  };

  /// Goes to the next line that is neither blank nor a comment; false at the end.
  bool next_line() {
    do {
      if (!lines_.next()) return false;
      line_ = trimmed(lines_.here());
      if (line_.find('\0') != std::string_view::npos)
        lines_.refuse("a byte with the value 0", "a text file, not a binary file");
    } while (line_.empty() || line_.starts_with("**"));
    if (line_.front() != '*') lines_.refuse_unended();
    return true;
  }

  void begin_block() {
    const std::string line = without_case_and_blanks(line_);
    const std::string keyword = line.substr(0, line.find(','));
    includes_ = includes_ || keyword == "*INCLUDE";
    holds_ = keyword == "*NODE" ? data::nodes : data::ignored;
    if (keyword != "*ELEMENT") return;
    const std::string parameter = ",TYPE=";
    const std::size_t at = line.find(parameter);
    const std::size_t from = at + parameter.size();
    type_ = at == std::string::npos ? "" : line.substr(from, line.find(',', from) - from);
    if (type_.empty()) lines_.refuse("*ELEMENT without TYPE", "*ELEMENT, TYPE=..., such as TYPE=C3D8");
    solid_ = solid_of(type_);
    holds_ = solid_ != nullptr ? data::solids : data::others;
    continues_ = false;
  }

  void read_node() {
    const std::vector<std::string_view> fields = fields_of(line_);
    const int number = lines_.whole(fields[0], 1, any_number, "the node's number");
    if (fields.size() < 2) lines_.refuse(field_words(line_, "a line"), "number, x, y, z");
    placed_node node{std::to_string(number), {}};
    // In CalculiX a missing coordinate is 0.
    for (std::size_t i = 0; i < 3 && i + 1 < fields.size(); ++i)
      node.at[i] = fields[i + 1].empty() ? 0.0 : lines_.real(fields[i + 1], "a coordinate", true);
    const auto [before, is_new] = index_.try_emplace(number, static_cast<int>(nodes_.size()));
    if (is_new)
      nodes_.push_back(std::move(node));
    else if (nodes_[before->second].at != node.at)
      lines_.refuse(fmt::format("node {} again, at another place", number), "each node at one place");
  }

  /// Reads a line with nodes of an element, which may have several lines; the type gives the number of nodes.
  void read_solid() {
    const std::vector<std::string_view> fields = fields_of(line_);
    std::size_t i = 0;
    if (element_.empty()) {
      (void)lines_.whole(fields[i++], 1, any_number, "the element's number");
      line_of_element_ = lines_.line();
    }
    for (; i < fields.size(); ++i) {
      if (element_.size() == solid_->nodes())
        lines_.refuse(field_words(line_, "a line"),
                      fmt::format("{} nodes for an element of type {}", solid_->nodes(), solid_->type));
      element_.push_back(lines_.whole(fields[i], 1, any_number, "a node's number"));
    }
    if (element_.size() == solid_->nodes()) end_element();
  }

  void end_element() {
    for (std::size_t k = 0; k < solid_->edges.size(); ++k) {
      const int from = element_[solid_->edges[k].first];
      const int to = element_[solid_->edges[k].second];
      const int middle = solid_->midside_nodes ? element_[solid_->corners + k] : to;
      sides_.push_back({from, middle, line_of_element_});
      sides_.push_back({middle, to, line_of_element_});
    }
    element_.clear();
  }

  void end_block() const {
    if (!element_.empty())
      refuse_line(lines_.file(), line_of_element_, fmt::format("an element with {} nodes", element_.size()),
                  fmt::format("{} nodes for type {}", solid_->nodes(), solid_->type));
  }

  /// The two nodes of each side, by index.
  [[nodiscard]] std::vector<std::pair<int, int>> indexed_sides() const {
    std::vector<std::pair<int, int>> sides;
    for (const side& s : sides_) {
      for (const int number : {s.from, s.to})
        if (!index_.contains(number))
          refuse_line(lines_.file(), s.line_of_element, fmt::format("node {} in an element", number),
                      includes_ ? "nodes that *NODE in this file defines; *INCLUDE is not followed"
                                : "nodes that *NODE defines");
      const auto& [first, second] = std::minmax(index_.at(s.from), index_.at(s.to));
      if (first != second) sides.emplace_back(first, second);
    }
    return sides;
  }

  [[nodiscard]] std::vector<std::string> left_out() const {
    std::vector<std::string> notes;
    if (includes_)
      notes.push_back(fmt::format(
          "*INCLUDE in {} is not followed: the contents of included files are not drawn.", lines_.file()));
    std::vector<std::string> types;
    for (const auto& [type, count] : others_)
      types.push_back(fmt::format("{} of type {}", count, in_quotes(type)));
    if (!types.empty())
      notes.push_back(fmt::format("Elements of {} whose edges are not known are not drawn: {}.",
                                  lines_.file(), joined(types, ", ")));
    return notes;
  }

  text_lines lines_;
  std::string_view line_;  // the current line, without blanks around it
  data holds_ = data::ignored;
  std::string type_;        // type of the block's elements
  bool continues_ = false;  // the line before, of an element of unknown type, ends with a comma
  std::vector<placed_node> nodes_;
  std::unordered_map<int, int> index_;  // index in nodes_ of each node number
  const solid* solid_ = nullptr;        // null: the type is unknown
  std::vector<int> element_;            // node numbers of an element that is not complete yet
  std::int64_t line_of_element_ = 0;
  std::vector<side> sides_;
  std::map<std::string, int> others_;  // number of elements of each unknown type
  bool includes_ = false;
};

}  // namespace

placed_nodes places_by_coordinates(std::string_view text, std::string_view file, const assembled& a) {
  placed_nodes places;
  places.nodes = parse_coordinates(text, file);
  if (place_dofs(a, places)) add_coupling_edges(a, places);
  return places;
}

placed_nodes places_by_mesh(std::string_view text, std::string_view file, const assembled& a) {
  placed_nodes places = inp_reader(text, file).read();
  if (place_dofs(a, places))
    drop_idle_nodes(places);
  else
    places.notes.push_back(
        fmt::format("no label of a dof, such as {}, names a node of {}.", in_quotes(a.label_of(0)), file));
  return places;
}

}  // namespace contct
