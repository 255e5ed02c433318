#include "contct/matrix/band_matrix.hpp"

#include <algorithm>

namespace contct::matrix {

band_matrix::band_matrix(int order, int subdiagonals)
    : order_(order),
      subdiagonals_(subdiagonals),
      entries_(static_cast<std::size_t>(order) * (subdiagonals + 1), 0.0) {}

void band_matrix::add(std::size_t row, std::size_t column, double value) {
  at(std::max(row, column), std::min(row, column)) += value;
}

}  // namespace contct::matrix
