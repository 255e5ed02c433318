#include "contct/certify/long_factor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace contct::certify {
namespace {

using numeric::double_double;

double_double root_of(const double_double& x) {
  const double near = std::sqrt(x.hi);
  const double_double left = x - numeric::exact_product(near, near);
  return numeric::renormalized(near, left.hi / (2 * near));
}

/// The sum of l_ik l_jk over the columns k < `end` that both rows have.
double_double product(const long_band& l, int i, int j, int end) {
  double_double sum;
  for (int k = std::max(l.first(i), l.first(j)); k < end; ++k) sum += l.at(i, k) * l.at(j, k);
  return sum;
}

}  // namespace

bool can_be_factored_long(int order, int subdiagonals) {
  constexpr double most_products = 1e7;
  return static_cast<double>(order) * (subdiagonals + 1) * (subdiagonals + 1) <= most_products;
}

bool factor(long_band& a) {
  for (int i = 0; i < a.order(); ++i) {
    for (int j = a.first(i); j < i; ++j) a.at(i, j) = (a.at(i, j) - product(a, i, j, j)) / a.at(j, j);
    const double_double pivot = a.at(i, i) - product(a, i, i, i);
    if (!(pivot.hi > 0.0) || !std::isfinite(pivot.hi)) return false;
    a.at(i, i) = root_of(pivot);
  }
  return true;
}

void solve_with(const long_band& l, std::span<double_double> x) {
  for (int i = 0; i < l.order(); ++i) {
    for (int k = l.first(i); k < i; ++k) x[i] -= l.at(i, k) * x[k];
    x[i] = x[i] / l.at(i, i);
  }
  for (int i = l.order(); i-- > 0;) {
    x[i] = x[i] / l.at(i, i);
    for (int k = l.first(i); k < i; ++k) x[k] -= l.at(i, k) * x[i];
  }
}

/// The magnitudes of a product of two rows add up to at most 1.1: their squares are the diagonal's.
double largest_row_of_error(const long_band& a, const long_band& l, double rounding) {
  const int b = a.subdiagonals();
  const double of_entry = 2.0 * (b + 4) * 0x1p-98 + rounding;
  std::vector<double> sums(a.order(), (2 * b + 1) * of_entry);
  for (int i = 0; i < a.order(); ++i) {
    for (int j = a.first(i); j <= i; ++j) {
      const double error = std::abs((a.at(i, j) - product(l, i, j, j + 1)).hi);
      sums[i] += error;
      if (j != i) sums[j] += error;
    }
  }
  const auto finite = [](double sum) { return std::isfinite(sum); };
  if (!std::ranges::all_of(sums, finite)) return std::numeric_limits<double>::infinity();
  return std::ranges::max(sums) * (1 + 0x1p-30);
}

}  // namespace contct::certify
