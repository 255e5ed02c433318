// The entries of a symmetric matrix as a file has them, checked as a whole.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "contct/matrix/sparse_matrix.hpp"

namespace contct {

/// Collects the entries of one triangle and makes a matrix of them. 24 bytes an entry.
class entry_list {
 public:
  /// Room for as many entries as come.
  void reserve(std::size_t entries) { entries_.reserve(entries); }
  /// An entry of the lower triangle, row >= column, from 0, and the line it stands in.
  void add(const matrix_entry& e, std::int64_t line) { entries_.push_back({e.row, e.column, e.value, line}); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  /// The matrix, without entries that are 0. Refuses (input_error, with `file` and line) more rows than
  /// entries, entries that are repeated, a negative diagonal, and a row that has entries but no diagonal.
  /// Linear in the entries.
  [[nodiscard]] sparse_matrix finish(int order, std::string_view file);

 private:
  struct read_entry {
    int row, column;
    double value;
    std::int64_t line;
  };
  void sort(int order);
  void refuse_repeated(std::string_view file) const;

  std::vector<read_entry> entries_;
};

}  // namespace contct
