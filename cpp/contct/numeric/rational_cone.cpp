#include "contct/numeric/rational_cone.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
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
    rounded_.reserve(parts.size());
    for (const vector& part : parts) rounded_.push_back(in_doubles(part));
  }

  bool reaches_zero() {
    while (cost() != 0) {
      const std::optional<std::size_t> enters = one_that_helps();
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

  static std::vector<double> in_doubles(const vector& x) {
    std::vector<double> all;
    for (const rational& number : x) all.push_back(rounded(number));
    return all;
  }

  /// A part that lowers the cost: the one that does so most, in doubles. Where many exchanges lowered
  /// nothing, Bland's, which is the first. A sign that rounding may decide is looked at exactly.
  [[nodiscard]] std::optional<std::size_t> one_that_helps() const {
    vector price(shares_.size());
    for (std::size_t i = 0; i < shares_.size(); ++i)
      for (std::size_t j = 0; is_artificial(i) && j < price.size(); ++j) price[j] += inverse_[i][j];
    const std::vector<double> near_price = in_doubles(price);
    std::optional<std::size_t> best;
    double most = 0.0;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      double gain = 0.0;
      double size = std::numeric_limits<double>::min();
      for (std::size_t j = 0; j < price.size(); ++j) {
        gain += near_price[j] * rounded_[part][j];
        size += std::abs(near_price[j] * rounded_[part][j]);
      }
      const double off = 16 * std::numeric_limits<double>::epsilon() * size;
      if (gain < -off || (best && gain <= most)) continue;
      if (!(gain > off) && (best || !gains_exactly(price, part))) continue;
      if (stalled_ > patience) return part;
      best = part;
      most = gain;
    }
    return best;
  }

  [[nodiscard]] bool gains_exactly(const vector& price, std::size_t part) const {
    rational gain;
    for (std::size_t j = 0; j < price.size(); ++j) gain += price[j] * parts_[part][j];
    return gain > 0;
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
    stalled_ = least == 0 ? stalled_ + 1 : 0;
  }

  std::span<const vector> parts_;
  std::vector<std::vector<double>> rounded_;          // the parts
  std::vector<vector> inverse_;                       // of the basis
  vector shares_;                                     // none is negative
  std::vector<std::optional<std::size_t>> in_basis_;  // the part of each row; none: its artificial one
  static constexpr int patience = 32;
  int stalled_ = 0;  // exchanges in a row that lowered no cost
};

}  // namespace

bool is_in_cone(const std::vector<rational>& sum, std::span<const std::vector<rational>> parts) {
  return phase_one(sum, parts).reaches_zero();
}

}  // namespace contct::numeric
