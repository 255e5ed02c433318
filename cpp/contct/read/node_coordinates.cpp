#include "contct/read/node_coordinates.hpp"

#include <fmt/format.h>

#include <unordered_map>

#include "contct/text/field_lines.hpp"
#include "contct/text/input_text.hpp"

namespace contct {
namespace {

/// How many fields stand before a comment.
std::size_t fields_before_comment(const field_lines& lines) {
  std::size_t count = 0;
  while (count < lines.fields() && count < field_lines::most_fields && lines.field(count).front() != '#')
    ++count;
  return count;
}

}  // namespace

std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file) {
  constexpr std::string_view allowed = "name x y, or name x y z";
  field_lines lines(text, file);
  std::vector<placed_node> nodes;
  std::unordered_map<std::string_view, std::int64_t> line_of;  // the text outlives it
  std::size_t alike = 0;
  while (lines.next()) {
    const std::size_t fields = fields_before_comment(lines);
    if (fields == 0) continue;
    if (fields != 3 && fields != 4) lines.refuse(quoted(lines.whole_line()), allowed);
    if (alike == 0) alike = fields;
    if (fields != alike)
      lines.refuse(fmt::format("{} coordinates for node {}", fields - 1, quoted(lines.field(0))),
                   fmt::format("{}, as the lines before have", alike - 1));
    const auto [before, is_new] = line_of.try_emplace(lines.field(0), lines.line());
    if (!is_new)
      lines.refuse(fmt::format("node {} again, which line {} has", quoted(lines.field(0)), before->second),
                   "each node once");
    nodes.push_back({std::string(lines.field(0)),
                     {lines.real(1, "x"), lines.real(2, "y"), fields == 4 ? lines.real(3, "z") : 0.0}});
  }
  if (nodes.empty()) refuse_line(file, 0, "no node", allowed);
  return nodes;
}

std::vector<placed_node> read_coordinates(const std::string& path) {
  return parse_coordinates(read_input(path, "file of coordinates", largest_mesh_file), path);
}

}  // namespace contct
