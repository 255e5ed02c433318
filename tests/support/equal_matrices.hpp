// Two matrices with the same numbers at the same places.
#pragma once

#include <algorithm>

#include "contct/matrix/stiffness_matrix.hpp"

namespace contct::matrix {

[[nodiscard]] inline bool equal(const sparse_matrix& a, const sparse_matrix& b) {
  return a.order == b.order &&
         std::ranges::equal(a.entries, b.entries, [](const matrix_entry& x, const matrix_entry& y) {
           return x.row == y.row && x.column == y.column && x.value == y.value;
         });
}

}  // namespace contct::matrix
