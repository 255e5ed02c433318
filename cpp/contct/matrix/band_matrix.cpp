#include "contct/matrix/band_matrix.hpp"

#include <algorithm>

namespace contct {

band_matrix::band_matrix(int order, int subdiagonals)
    : order_(order),
      subdiagonals_(subdiagonals),
      entries_(static_cast<std::size_t>(order) * static_cast<std::size_t>(subdiagonals + 1), 0.0) {}

void band_matrix::add(int row, int column, double value) {
  at(std::max(row, column), std::min(row, column)) += value;
}

void band_matrix::multiply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (int column = 0; column < order_; ++column) {
    const auto c = static_cast<std::size_t>(column);
    y[c] += at(column, column) * x[c];
    const int last = std::min(column + subdiagonals_, order_ - 1);
    for (int row = column + 1; row <= last; ++row) {
      const auto r = static_cast<std::size_t>(row);
      y[r] += at(row, column) * x[c];
      y[c] += at(row, column) * x[r];
    }
  }
}

}  // namespace contct
