#include "contct/matrix/without_zeros.hpp"

#include <algorithm>

namespace contct::matrix {

std::optional<stiffness_matrix> without_zeros(const stiffness_matrix& k) {
  if (!k.is_band()) return std::nullopt;
  const band_matrix& band = k.band();
  std::size_t zeros = 0;
  for (int column = 0; column < band.order(); ++column) {
    const int last = std::min(column + band.subdiagonals(), band.order() - 1);
    for (int row = column; row <= last; ++row) zeros += band.at(row, column) == 0.0 ? 1 : 0;
  }
  const auto stored = static_cast<std::size_t>(band.order()) * (band.subdiagonals() + 1);
  if (2 * zeros <= stored) return std::nullopt;
  return columns_of(band);
}

}  // namespace contct::matrix
