#include "contct/read/inp_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include "contct/read/node_coordinates.hpp"
#include "contct/text/field_lines.hpp"
#include "contct/text/input_text.hpp"

namespace contct {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(blanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

/// CalculiX takes no notice of case and blanks in a keyword's line.
std::string without_case_and_blanks(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if (blanks.find(c) != std::string_view::npos) continue;
    plain += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return plain;
}

/// The edges of a solid between its corners, from 0. Where it has nodes at its middles they come behind the
/// corners, in the order of the edges.
struct solid {
  std::string_view type;
  int corners;
  bool middles;
  std::span<const std::pair<int, int>> edges;

  [[nodiscard]] std::size_t nodes() const {
    return static_cast<std::size_t>(corners) + (middles ? edges.size() : 0);
  }
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

class inp_reader {
 public:
  inp_reader(std::string_view text, std::string_view file) : rest_(text), file_(file) {}

  placed_nodes read() {
    while (next()) {
      if (here_.front() == '*') {
        if (here_.substr(0, 2) != "**") begin_block();
      } else if (block_ == block::nodes) {
        read_node();
      } else if (block_ == block::solids) {
        read_solid();
      } else if (block_ == block::other_elements) {
        count_other();
      }
    }
    refuse_half_element();
    find_edges();
    say_what_is_left_out();
    return std::move(mesh_);
  }

 private:
  enum class block { other, nodes, solids, other_elements };

  /// To the next line that is not blank.
  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      here_ = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++line_;
      if (here_.empty()) continue;
      if (here_.find('\0') != std::string_view::npos) refuse("a byte of 0", "text: is it a binary file?");
      // A keyword cut short is none; a number cut short is a number.
      if (end == std::string_view::npos && here_.front() != '*')
        refuse(quoted(here_) + " without a line's end: the file may be cut short", "a line's end behind it");
      return true;
    }
    return false;
  }

  /// The fields of the line; one that is empty at the end does not count.
  void split() {
    fields_.clear();
    std::string_view left = here_;
    for (;;) {
      const std::size_t comma = left.find(',');
      fields_.push_back(trimmed(left.substr(0, comma)));
      if (comma == std::string_view::npos) break;
      left.remove_prefix(comma + 1);
    }
    if (fields_.size() > 1 && fields_.back().empty()) fields_.pop_back();
  }

  void begin_block() {
    refuse_half_element();
    const std::string plain = without_case_and_blanks(here_);
    const std::string keyword = plain.substr(0, plain.find(','));
    block_ = block::other;
    includes_ += keyword == "*INCLUDE" ? 1 : 0;
    if (keyword == "*NODE") block_ = block::nodes;
    if (keyword == "*ELEMENT") begin_elements(plain);
  }

  void begin_elements(const std::string& plain) {
    const std::string parameter = ",TYPE=";
    const std::size_t at = plain.find(parameter);
    const std::size_t from = at + parameter.size();
    const std::string type = at == std::string::npos ? "" : plain.substr(from, plain.find(',', from) - from);
    if (type.empty()) refuse(quoted(here_), "*ELEMENT, TYPE=..., as C3D8");
    solid_ = solid_of(type);
    block_ = solid_ != nullptr ? block::solids : block::other_elements;
    other_type_ = type;
    continues_ = false;
  }

  void read_node() {
    split();
    const int number = whole(0, "the node's number");
    if (fields_.size() < 2) refuse(quoted(here_), "number, x, y, z");
    placed_node node{std::to_string(number), {}};
    // As CalculiX has it: what is not there is 0.
    for (std::size_t i = 0; i < 3 && i + 1 < fields_.size(); ++i)
      node.at[i] = fields_[i + 1].empty() ? 0.0 : real(i + 1);
    const auto [before, is_new] = index_.try_emplace(number, static_cast<int>(mesh_.nodes.size()));
    if (is_new) {
      mesh_.nodes.push_back(std::move(node));
    } else if (mesh_.nodes[static_cast<std::size_t>(before->second)].at != node.at) {
      refuse(fmt::format("node {} again, at another place", number), "each node at one place");
    }
  }

  /// An element's nodes may stand on several lines; how many there are says its type.
  void read_solid() {
    split();
    std::size_t i = 0;
    if (corner_numbers_.size() == first_of_element_) {
      (void)whole(0, "the element's number");
      element_line_ = line_;
      i = 1;
    }
    for (; i < fields_.size(); ++i) {
      if (corner_numbers_.size() - first_of_element_ == solid_->nodes())
        refuse(quoted(here_),
               fmt::format("{} nodes for an element of type {}", solid_->nodes(), solid_->type));
      corner_numbers_.push_back(whole(i, "a node's number"));
    }
    if (corner_numbers_.size() - first_of_element_ < solid_->nodes()) return;
    elements_.push_back({solid_, first_of_element_, element_line_});
    first_of_element_ = corner_numbers_.size();
  }

  void refuse_half_element() const {
    if (corner_numbers_.size() == first_of_element_) return;
    refuse_line(file_, element_line_,
                fmt::format("an element with {} nodes", corner_numbers_.size() - first_of_element_),
                fmt::format("{} nodes for type {}", solid_->nodes(), solid_->type));
  }

  /// Of other types no more is known than that a comma at a line's end continues it.
  void count_other() {
    if (!continues_) ++others_[other_type_];
    continues_ = here_.back() == ',';
  }

  [[nodiscard]] int whole(std::size_t i, std::string_view what) const {
    const std::string_view text = fields_[i];
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < 1)
      refuse(fmt::format("{} for {}", quoted(text), what),
             fmt::format("a whole number from 1 to {}", std::numeric_limits<int>::max()));
    return value;
  }

  /// FORTRAN reads these numbers: a D may stand for the E, and a plus sign before a number.
  [[nodiscard]] double real(std::size_t i) const {
    std::string text(fields_[i]);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const std::size_t plus = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data() + plus, text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      refuse(fmt::format("{} for a coordinate", quoted(fields_[i])),
             "a finite number within the range of double precision, as 1.5 or -2e-3");
    return value;
  }

  [[nodiscard]] int index_of(int number, std::int64_t line) const {
    const auto at = index_.find(number);
    if (at != index_.end()) return at->second;
    refuse_line(file_, line, fmt::format("node {} in an element", number),
                includes_ > 0 ? "nodes that *NODE has in this file: *INCLUDE is not followed"
                              : "nodes that *NODE has");
  }

  void add_edge(int from, int to) {
    if (from != to) edges_.emplace_back(std::min(from, to), std::max(from, to));
  }

  /// Each edge once, with how many elements have it.
  void find_edges() {
    for (const element& e : elements_) {
      const auto node = [&](std::size_t i) { return index_of(corner_numbers_[e.first + i], e.line); };
      for (std::size_t k = 0; k < e.of->edges.size(); ++k) {
        const int from = node(static_cast<std::size_t>(e.of->edges[k].first));
        const int to = node(static_cast<std::size_t>(e.of->edges[k].second));
        if (e.of->middles) {
          const int middle = node(static_cast<std::size_t>(e.of->corners) + k);
          add_edge(from, middle);
          add_edge(middle, to);
        } else {
          add_edge(from, to);
        }
      }
    }
    std::sort(edges_.begin(), edges_.end());
    for (const auto& [from, to] : edges_) {
      const bool same =
          !mesh_.edges.empty() && mesh_.edges.back().from == from && mesh_.edges.back().to == to;
      if (!same) mesh_.edges.push_back({from, to, 0});
      ++mesh_.edges.back().elements;
    }
  }

  void say_what_is_left_out() {
    if (includes_ > 0)
      mesh_.said.push_back(
          fmt::format("*INCLUDE in {} is not followed: what such files hold is not drawn.", file_));
    if (others_.empty()) return;
    std::string types;
    for (const auto& [type, number] : others_)
      types += fmt::format("{}{} of type {}", types.empty() ? "" : ", ", number, quoted(type));
    mesh_.said.push_back(
        fmt::format("Of {}, elements whose edges are not known are not drawn: {}.", file_, types));
  }

  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const {
    refuse_line(file_, line_, found, allowed);
  }

  struct element {
    const solid* of;
    std::size_t first;  // of its nodes' numbers
    std::int64_t line;
  };

  std::string_view rest_, file_, here_;
  std::int64_t line_ = 0;
  std::vector<std::string_view> fields_;
  block block_ = block::other;
  const solid* solid_ = nullptr;
  std::string other_type_;
  bool continues_ = false;
  std::size_t includes_ = 0;
  std::map<std::string, std::size_t> others_;  // how many of each type that has no edges
  std::unordered_map<int, int> index_;         // of a node, by its number
  std::vector<int> corner_numbers_;            // of all solids, one after the other
  std::size_t first_of_element_ = 0;
  std::int64_t element_line_ = 0;
  std::vector<element> elements_;
  std::vector<std::pair<int, int>> edges_;
  placed_nodes mesh_;
};

}  // namespace

placed_nodes parse_inp_mesh(std::string_view text, std::string_view file) {
  return inp_reader(text, file).read();
}

placed_nodes read_inp_mesh(const std::string& path) {
  return parse_inp_mesh(read_input(path, "input file of CalculiX", largest_mesh_file), path);
}

}  // namespace contct
