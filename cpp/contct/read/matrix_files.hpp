// Files that hold a stiffness matrix or a load vector, Matrix Market's and what CalculiX writes; and those
// that hold the labels of its dofs, and where these are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contct/model/problem.hpp"

namespace contct {

/// No such file may be larger, in MiB.
inline constexpr std::size_t largest_matrix_file = 16384;

/// "%%MatrixMarket matrix coordinate real symmetric": the lower triangle, from 1, each place once. The words
/// of the header in any case; comments behind it, and blank lines. Linear in the text, but for sorting; the
/// declared entry count is not used to allocate memory. The matrix has no entries that are 0. Throws
/// input_error for anything else, a negative diagonal, and a row that has entries but no diagonal.
/// `warnings`: one is appended where numbers are not the shortest decimals of their doubles.
[[nodiscard]] sparse_matrix parse_symmetric(std::string_view text, std::string_view file,
                                            std::vector<std::string>* warnings = nullptr);

/// JOB.sti of *FREQUENCY, SOLVER=MATRIXSTORAGE: "row column value" a line, from 1, the upper triangle, each
/// place once, zeros included; D may stand for E. The number of rows is not in it, but in JOB.dof. Throws
/// input_error likewise.
[[nodiscard]] sparse_matrix parse_calculix_stiffness(std::string_view text, std::string_view file, int rows,
                                                     std::vector<std::string>* warnings = nullptr);

/// "%%MatrixMarket matrix array real general" with one column of `rows` numbers, or "coordinate" with those
/// that are not 0. Throws input_error. `warnings` likewise.
[[nodiscard]] std::vector<double> parse_vector(std::string_view text, std::string_view file, int rows,
                                               std::vector<std::string>* warnings = nullptr);

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

/// "name x y" or "name x y z" a line, all lines alike, each name once; a field that begins with # and what
/// follows it are a comment. Without z it is 0. Throws input_error.
[[nodiscard]] std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file);

}  // namespace contct
