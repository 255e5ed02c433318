#include "contct/read/dof_labels.hpp"

#include <fmt/format.h>

#include <charconv>

#include "contct/read/matrix_market.hpp"
#include "contct/text/field_lines.hpp"
#include "contct/text/input_text.hpp"

namespace contct {

std::vector<std::string> parse_labels(std::string_view text, std::string_view file) {
  constexpr std::size_t longest = 100;
  field_lines lines(text, file);
  std::vector<std::string> labels;
  std::unordered_map<std::string_view, std::int64_t> line_of;  // the text outlives it, the labels move
  while (lines.next()) {
    lines.expect(1, "one label a line, without blanks");
    const std::string_view label = lines.field(0);
    if (label.size() > longest)
      lines.refuse(quoted(label), fmt::format("a label of at most {} bytes", longest));
    const auto [before, is_new] = line_of.try_emplace(label, lines.line());
    if (!is_new)
      lines.refuse(fmt::format("label {} again, which line {} has", quoted(label), before->second),
                   "each label once");
    labels.emplace_back(label);
  }
  if (labels.empty()) refuse_line(file, 0, "no label", "one label a line");
  return labels;
}

std::vector<std::string> read_labels(const std::string& path) {
  return parse_labels(read_input(path, "list of labels", largest_matrix_file), path);
}

dof_index::dof_index(const assembled& a) : structure_(a) {
  for (std::size_t dof = 0; dof < a.labels.size(); ++dof) dofs_.emplace(a.labels[dof], static_cast<int>(dof));
}

std::optional<int> dof_index::find(std::string_view label) const {
  if (!structure_.labels.empty()) {
    const auto at = dofs_.find(label);
    return at == dofs_.end() ? std::nullopt : std::optional(at->second);
  }
  int number = 0;
  const char* const end = label.data() + label.size();
  const auto [stop, error] = std::from_chars(label.data(), end, number);
  // "01" and "+1" are no labels: the dof has one name.
  if (error != std::errc{} || stop != end || number < 1 || number > structure_.dofs() || label.front() == '0')
    return std::nullopt;
  return number - 1;
}

std::string dof_index::allowed() const {
  if (structure_.labels.empty()) return fmt::format(R"(a label, "1" to "{}")", structure_.dofs());
  return fmt::format("a label of {}, such as {}", structure_.labels_from, quoted(structure_.labels.front()));
}

}  // namespace contct
