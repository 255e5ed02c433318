#include "contct/matrix/stiffness_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace contct::matrix {
namespace {

/// Column by column, `on(column, value)` for the diagonal and `below(row, column, value)` for the rest.
template <class Matrix, class On, class Below>
void each_entry(Matrix& k, On on, Below below) {
  for (int column = 0; column < k.order(); ++column) {
    if constexpr (std::is_same_v<std::remove_const_t<Matrix>, band_matrix>) {
      on(column, k.at(column, column));
      const int last = std::min(column + k.subdiagonals(), k.order() - 1);
      for (int row = column + 1; row <= last; ++row) below(row, column, k.at(row, column));
    } else {
      const int first = k.starts[column];
      on(column, k.values[first]);
      for (int i = first + 1; i < k.starts[column + 1]; ++i) below(k.rows[i], column, k.values[i]);
    }
  }
}

template <class Matrix, class Real>
void subtract(const Matrix& k, std::span<const Real> x, std::span<long double> r) {
  each_entry(
      k, [&](std::size_t i, double value) { r[i] -= value * static_cast<long double>(x[i]); },
      [&](std::size_t row, std::size_t column, double value) {
        r[row] -= value * static_cast<long double>(x[column]);
        r[column] -= value * static_cast<long double>(x[row]);
      });
}

}  // namespace

int stiffness_matrix::order() const {
  return std::visit([](const auto& k) { return k.order(); }, stored_);
}

double stiffness_matrix::diagonal(std::size_t row) const {
  return is_band() ? band().at(row, row) : columns().diagonal(row);
}

void stiffness_matrix::add_to_diagonal(std::size_t row, double value) {
  (is_band() ? band().at(row, row) : columns().diagonal(row)) += value;
}

std::vector<double> stiffness_matrix::diagonal_with(std::span<const spring_at> springs) const {
  std::vector<double> all(order());
  for (std::size_t row = 0; row < all.size(); ++row) all[row] = diagonal(row);
  for (const spring_at& s : springs) all[s.row] += s.stiffness;
  return all;
}

void stiffness_matrix::fix(std::span<const char> fixed) {
  std::visit(
      [fixed](auto& k) {
        each_entry(
            k,
            [fixed](std::size_t i, double& value) {
              if (fixed[i] != 0) value = 1.0;
            },
            [fixed](std::size_t row, std::size_t column, double& value) {
              if (fixed[row] != 0 || fixed[column] != 0) value = 0.0;
            });
      },
      stored_);
}

void stiffness_matrix::scale(std::span<const double> d) {
  std::visit(
      [d](auto& k) {
        each_entry(
            k, [d](std::size_t i, double& value) { value *= d[i] * d[i]; },
            [d](std::size_t row, std::size_t column, double& value) { value *= d[row] * d[column]; });
      },
      stored_);
}

void stiffness_matrix::subtract_product(std::span<const double> x, std::span<long double> r) const {
  std::visit([x, r](const auto& k) { subtract(k, x, r); }, stored_);
}

void stiffness_matrix::subtract_product(std::span<const long double> x, std::span<long double> r) const {
  std::visit([x, r](const auto& k) { subtract(k, x, r); }, stored_);
}

double stiffness_matrix::one_norm(std::span<const double> diagonal, std::span<const double> d) const {
  std::vector<double> sums(d.size(), 0.0);
  std::visit(
      [&](const auto& k) {
        each_entry(
            k, [&](std::size_t i, double /*own*/) { sums[i] += std::abs(diagonal[i] * (d[i] * d[i])); },
            [&](std::size_t row, std::size_t column, double value) {
              const double size = std::abs(value * (d[row] * d[column]));
              sums[row] += size;
              sums[column] += size;
            });
      },
      stored_);
  return sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
}

}  // namespace contct::matrix
