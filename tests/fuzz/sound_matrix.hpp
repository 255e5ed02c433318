// What every reader of a matrix promises of its entries.
#pragma once

#include <cmath>
#include <utility>

#include "contct/matrix/stiffness_matrix.hpp"
#include "fuzz/fuzz.hpp"

namespace contct::fuzz {

inline void require_sound(const matrix::sparse_matrix& m) {
  const matrix::matrix_entry* before = nullptr;
  for (const matrix::matrix_entry& e : m.entries) {
    require(e.column >= 0 && e.column <= e.row && e.row < m.order, "an entry is in the lower triangle");
    require(std::isfinite(e.value) && e.value != 0.0, "an entry is a number other than 0");
    require(e.row != e.column || e.value > 0.0, "the diagonal is positive");
    require(before == nullptr || std::pair(before->column, before->row) < std::pair(e.column, e.row),
            "entries are in the order of columns and rows");
    before = &e;
  }
}

}  // namespace contct::fuzz
