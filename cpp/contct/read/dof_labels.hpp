// The labels of a matrix's dofs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contct/structure/assembled.hpp"

namespace contct::read {

/// One label a line, in the matrix's order: any text without blanks, each once. Throws input_error.
[[nodiscard]] std::vector<std::string> parse_labels(std::string_view text, std::string_view file);

/// Finds dofs by their labels.
class dof_index {
 public:
  /// `a` must outlive this object.
  explicit dof_index(const assembled& a);

  /// The dof, from 0, or nothing.
  [[nodiscard]] std::optional<int> find(std::string_view label) const;

  /// What labels there are, for messages.
  [[nodiscard]] std::string allowed() const;

 private:
  const assembled& structure_;
  std::unordered_map<std::string_view, int> dofs_;  // empty where the labels are the dofs' numbers
};

}  // namespace contct::read
