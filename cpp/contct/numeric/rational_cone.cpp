#include "contct/numeric/rational_cone.hpp"

#include <cstddef>
#include <optional>
#include <utility>

namespace contct::numeric {
namespace {

using vector = std::vector<rational>;

/// Equations sum = basis * shares, solved for their shares. At first the basis has a part of its own for each
/// equation, which costs as much as its share; the least cost is 0 where `sum` is in the cone.
class phase_one {
 public:
  phase_one(const vector& sum, std::span<const vector> parts)
      : parts_(parts), inverse_(sum.size(), vector(sum.size())), shares_(sum), in_basis_(sum.size()) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      inverse_[i][i] = sum[i] < 0 ? -1 : 1;
      shares_[i] = abs(sum[i]);
    }
  }

  bool reaches_zero() {
    while (cost() != 0) {
      const std::optional<std::size_t> enters = first_that_helps();
      if (!enters) return false;
      exchange(*enters);
    }
    return true;
  }

 private:
  [[nodiscard]] bool is_artificial(std::size_t row) const { return !in_basis_[row]; }

  [[nodiscard]] rational cost() const {
    rational sum;
    for (std::size_t i = 0; i < shares_.size(); ++i)
      if (is_artificial(i)) sum += shares_[i];
    return sum;
  }

  /// Bland: the first part that lowers the cost.
  [[nodiscard]] std::optional<std::size_t> first_that_helps() const {
    vector price(shares_.size());
    for (std::size_t i = 0; i < shares_.size(); ++i)
      for (std::size_t j = 0; is_artificial(i) && j < price.size(); ++j) price[j] += inverse_[i][j];
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      rational gain;
      for (std::size_t j = 0; j < price.size(); ++j) gain += price[j] * parts_[part][j];
      if (gain > 0) return part;
    }
    return std::nullopt;
  }

  /// It enters for the row that limits it; of several, artificial ones first, then the first part.
  void exchange(std::size_t enters) {
    const std::size_t n = shares_.size();
    vector column(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) column[i] += inverse_[i][j] * parts_[enters][j];
    std::size_t leaves = n;
    rational least;
    for (std::size_t i = 0; i < n; ++i) {
      if (column[i] <= 0) continue;
      const rational limit = shares_[i] / column[i];
      if (leaves == n || limit < least || (limit == least && in_basis_[i] < in_basis_[leaves])) {
        leaves = i;
        least = limit;
      }
    }
    // The cost is bounded by 0, so something limits what lowers it.
    for (rational& x : inverse_[leaves]) x /= column[leaves];
    shares_[leaves] = least;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == leaves || column[i] == 0) continue;
      for (std::size_t j = 0; j < n; ++j) inverse_[i][j] -= column[i] * inverse_[leaves][j];
      shares_[i] -= column[i] * least;
    }
    in_basis_[leaves] = enters;
  }

  std::span<const vector> parts_;
  std::vector<vector> inverse_;                       // of the basis
  vector shares_;                                     // none is negative
  std::vector<std::optional<std::size_t>> in_basis_;  // the part of each row; none: its artificial one
};

}  // namespace

bool is_in_cone(const std::vector<rational>& sum, std::span<const std::vector<rational>> parts) {
  return phase_one(sum, parts).reaches_zero();
}

}  // namespace contct::numeric
