#include "contct/read/dof_labels.hpp"

#include <fmt/format.h>

#include "contct/text/input_text.hpp"

namespace contct::read {

std::vector<std::string> parse_labels(std::string_view text, std::string_view file) {
  constexpr std::size_t longest = 100;
  field_lines lines(text, file);
  std::vector<std::string> labels;
  std::unordered_map<std::string_view, std::int64_t> line_of;  // views of the text: the labels move
  while (lines.next()) {
    lines.expect(1, "one label a line, without blanks");
    const std::string_view label = lines.field(0);
    if (label.size() > longest)
      lines.refuse(in_quotes(label), fmt::format("a label of at most {} bytes", longest));
    const auto [before, is_new] = line_of.try_emplace(label, lines.line());
    if (!is_new)
      lines.refuse(fmt::format("label {} again, which line {} has", in_quotes(label), before->second),
                   "each label once");
    labels.emplace_back(label);
  }
  if (labels.empty()) refuse_line(file, 0, "no label", "one label a line");
  return labels;
}

dof_index::dof_index(const assembled& a) : structure_(a) {
  for (const std::string& label : a.labels) dofs_.emplace(label, static_cast<int>(dofs_.size()));
}

std::optional<int> dof_index::find(std::string_view label) const {
  if (!structure_.labels.empty()) {
    const auto at = dofs_.find(label);
    return at == dofs_.end() ? std::nullopt : std::optional(at->second);
  }
  const auto number = number_in<int>(label);
  // "01" and "+1" are no labels: a dof has one name.
  if (!number || *number < 1 || *number > structure_.dofs() || label.front() == '0') return std::nullopt;
  return *number - 1;
}

std::string dof_index::allowed() const {
  if (structure_.labels.empty()) return fmt::format(R"(a label, "1" to "{}")", structure_.dofs());
  return fmt::format("a label of {}, such as {}", structure_.labels_from,
                     in_quotes(structure_.labels.front()));
}

}  // namespace contct::read
