#include "contct/exact/definite.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace contct::exact {
namespace {

/// floor(x 2^shift).
integer floor_of(const rational& x, int shift) {
  integer top = numerator(x);
  integer bottom = denominator(x);
  if (shift >= 0) top <<= static_cast<unsigned>(shift);
  if (shift < 0) bottom <<= static_cast<unsigned>(-shift);
  integer quotient = top / bottom;
  if (top < 0 && quotient * bottom != top) --quotient;
  return quotient;
}

/// x 2^shift.
rational shifted(const rational& x, int shift) {
  const integer power = integer(1) << static_cast<unsigned>(std::abs(shift));
  return shift < 0 ? rational(x / rational(power)) : rational(x * rational(power));
}

/// A row of the lower triangle, from its first column that is not 0 on; the diagonal is its last.
struct triangle_row {
  std::size_t first = 0;
  std::vector<integer> values;
};

/// K on the dofs with pivots in the order of the band, each scaled by a power of two so that the diagonal is
/// between 1/2 and 8.
class scaled_matrix {
 public:
  scaled_matrix(const sparse_rows& k, std::span<const int> place, const lifted_solver& pivots) : k_(k) {
    for (std::size_t dof = 0; dof < k.size(); ++dof)
      if (pivots.has_pivot(dof)) dof_.push_back(dof);
    std::ranges::sort(dof_, {}, [&](std::size_t dof) { return place[dof]; });
    row_.assign(k.size(), none);
    for (std::size_t i = 0; i < dof_.size(); ++i) row_[dof_[i]] = i;
    for (std::size_t i = 0; i < dof_.size(); ++i) {
      const rational diagonal = entry(i, i);
      const int bits = diagonal > 0 ? static_cast<int>(bits_in(numerator(diagonal))) -
                                          static_cast<int>(bits_in(denominator(diagonal)))
                                    : 0;
      exponent_.push_back(bits >= 0 ? bits / 2 : -((1 - bits) / 2));
      std::size_t first = i;
      for (const auto& [column, value] : k[dof_[i]])
        if (const std::size_t j = row_[column]; j < i && value != 0) first = std::min(first, j);
      first_.push_back(first);
      width_ = std::max(width_, i - first);
    }
  }

  [[nodiscard]] std::size_t order() const { return dof_.size(); }
  [[nodiscard]] std::size_t first(std::size_t row) const { return first_[row]; }
  /// Entries below the diagonal of the widest row.
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t entries() const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < order(); ++i) sum += i - first_[i] + 1;
    return sum;
  }

  [[nodiscard]] rational entry(std::size_t row, std::size_t column) const {
    return k_[dof_[row]].at(static_cast<int>(dof_[column]));
  }

  /// The entries of a row up to its diagonal, with `bits` bits behind the point, rounded down.
  [[nodiscard]] std::vector<integer> scaled_row(std::size_t row, int bits) const {
    std::vector<integer> entries(row - first_[row] + 1);
    for (const auto& [column, value] : k_[dof_[row]])
      if (const std::size_t j = row_[column]; j <= row && value != 0)
        entries[j - first_[row]] = floor_of(value, bits - exponent_[row] - exponent_[j]);
    return entries;
  }

  /// The displacement that is x, with `bits` bits behind the point, before the scaling; x has rows from 0 on.
  [[nodiscard]] std::optional<negative_work> work_on(const std::vector<integer>& x, int bits) const {
    negative_work w{vector(k_.size()), 0};
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i] != 0) w.motion[dof_[i]] = shifted(rational(x[i]), -bits - exponent_[i]);
    for (std::size_t dof = 0; dof < k_.size(); ++dof) {
      if (w.motion[dof] == 0) continue;
      for (const auto& [column, value] : k_[dof]) w.work += w.motion[dof] * value * w.motion[column];
    }
    return w.work < 0 ? std::optional(std::move(w)) : std::nullopt;
  }

  /// Two dofs that are enough: K_ij^2 > K_ii K_jj, or a diagonal that is not positive. Also bounds the scaled
  /// entries by 8.
  [[nodiscard]] std::optional<negative_work> negative_pair() const {
    for (std::size_t i = 0; i < order(); ++i) {
      const rational own = entry(i, i);
      for (const auto& [column, value] : k_[dof_[i]]) {
        const std::size_t j = row_[column];
        if (j > i || value == 0) continue;
        const rational other = entry(j, j);
        if (own > 0 && (i == j || value * value <= own * other)) continue;
        negative_work w{vector(k_.size()), 0};
        // On x at i and 1 at j the work is K_ii x^2 + 2 K_ij x + K_jj.
        const rational x = own > 0 ? rational(-value / own) : rational(-(other + 1) / (2 * value));
        w.motion[dof_[i]] = i == j ? rational(1) : x;
        if (i != j) w.motion[dof_[j]] = 1;
        w.work = i == j ? own : rational(own * x * x + 2 * value * x + other);
        if (w.work < 0) return w;
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t none = -1;
  static std::size_t bits_in(const integer& n) { return boost::multiprecision::msb(n) + 1; }

  const sparse_rows& k_;
  std::vector<std::size_t> dof_, row_;  // of a row; of a dof
  std::vector<int> exponent_;           // of the power of two that scales a row
  std::vector<std::size_t> first_;      // column of a row that is not 0
  std::size_t width_ = 0;
};

/// Cholesky's method on the scaled matrix less c, in numbers with as many bits behind the point as are asked
/// for.
class triangle {
 public:
  triangle(const scaled_matrix& of, int bits) : of_(of), bits_(static_cast<unsigned>(bits)) {
    // With l < 3 on the diagonal and below it, and products that are exact, what is left of an entry is less
    // than 6 units of the last bit of L, and its own rounding less than 1.
    shift_ = integer(8 * (2 * of.width() + 1)) << bits_;
  }

  /// True where L is whole: the matrix is definite.
  bool factor() {
    rows_.reserve(of_.order());
    for (std::size_t i = 0; i < of_.order(); ++i)
      if (!add_row(i)) return false;
    return true;
  }

  /// Where it failed: x' (K - c) x <= 0 for the x that ends with 1 in the failed row, up to rounding.
  [[nodiscard]] std::vector<integer> suspect() const {
    const triangle_row& failed = rows_.back();
    const std::size_t end = failed.first + failed.values.size();  // columns that it had reached
    std::vector<integer> x(rows_.size());
    x.back() = integer(1) << bits_;
    for (std::size_t j = failed.first; j < end; ++j) x[j] = -failed.values[j - failed.first];
    for (std::size_t j = end; j-- > 0;) {
      if (x[j] == 0) continue;
      const triangle_row& row = rows_[j];
      x[j] = (x[j] << bits_) / row.values.back();
      for (std::size_t k = row.first; k < j; ++k) x[k] -= (row.values[k - row.first] * x[j]) >> bits_;
    }
    return x;
  }

 private:
  /// False where its pivot is not positive. Then the row has the columns up to there.
  bool add_row(std::size_t i) {
    const std::vector<integer> entries = of_.scaled_row(i, 2 * static_cast<int>(bits_));
    rows_.push_back({of_.first(i), {}});
    triangle_row& row = rows_.back();
    integer pivot = entries.back() - shift_;
    for (std::size_t j = row.first; j < i; ++j) {
      if (pivot <= 0) return false;
      integer rest = entries[j - row.first];
      const triangle_row& other = rows_[j];
      for (std::size_t k = std::max(row.first, other.first); k < j; ++k)
        rest -= row.values[k - row.first] * other.values[k - other.first];
      row.values.push_back(rest / other.values.back());
      pivot -= row.values.back() * row.values.back();
    }
    if (pivot <= 0) return false;
    row.values.push_back(sqrt(pivot));
    return row.values.back() > 0;
  }

  const scaled_matrix& of_;
  unsigned bits_;
  integer shift_;
  std::vector<triangle_row> rows_;
};

}  // namespace

std::optional<negative_work> find_negative_work(const sparse_rows& k, std::span<const char> fixed,
                                                std::span<const int> place, std::int64_t most_bytes) {
  constexpr int most_bits = 16'384;
  lifted_solver pivots(k, fixed, place);
  pivots.factor({});
  const scaled_matrix scaled(k, place, pivots);
  if (std::optional<negative_work> found = scaled.negative_pair()) return found;
  for (int bits = 64;; bits *= 2) {
    const double bytes = static_cast<double>(scaled.entries()) * (24.0 + bits / 8.0);
    if (bits > most_bits || bytes > static_cast<double>(most_bytes))
      throw std::runtime_error("whether the stiffness matrix is positive semidefinite is not decided with " +
                               std::to_string(bits / 2) + " bits; " + std::to_string(bits) + " would take " +
                               std::to_string(static_cast<std::int64_t>(bytes / (1 << 20)) + 1) + " MiB");
    triangle l(scaled, bits);
    if (l.factor()) return std::nullopt;
    if (std::optional<negative_work> found = scaled.work_on(l.suspect(), bits)) return found;
  }
}

}  // namespace contct::exact
