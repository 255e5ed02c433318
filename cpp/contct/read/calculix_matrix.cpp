#include "contct/read/calculix_matrix.hpp"

#include <fmt/format.h>

#include "contct/read/entry_list.hpp"
#include "contct/read/matrix_market.hpp"
#include "contct/text/field_lines.hpp"
#include "contct/text/input_text.hpp"

namespace contct {

sparse_matrix parse_calculix_stiffness(std::string_view text, std::string_view file, int rows) {
  field_lines lines(text, file);
  entry_list entries;
  while (lines.next()) {
    lines.expect(3, "row, column and value");
    const int row = lines.whole(0, 1, rows, "the row") - 1;
    const int column = lines.whole(1, 1, rows, "the column") - 1;
    if (row > column)
      lines.refuse(fmt::format("row {} and column {}, below the diagonal", row + 1, column + 1),
                   "the upper triangle, row <= column, as CalculiX writes it");
    entries.add({column, row, lines.real(2, "an entry")}, lines.line());  // the same place below
  }
  return entries.finish(rows, file);
}

sparse_matrix read_calculix_stiffness(const std::string& path, int rows) {
  return parse_calculix_stiffness(read_input(path, "stiffness matrix of CalculiX", largest_matrix_file), path,
                                  rows);
}

}  // namespace contct
