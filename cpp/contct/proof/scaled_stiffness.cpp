#include "contct/proof/scaled_stiffness.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

#include "contct/linear/cholesky.hpp"

namespace contct {
namespace {

/// The power of two whose square times a positive `x` is between 1/8 and 1.
double root_scale(double x) {
  if (!(x > 0.0)) return 1.0;
  int exponent = 0;
  (void)std::frexp(x, &exponent);
  return std::ldexp(1.0, -((exponent + (exponent > 0 ? 1 : 0)) / 2));
}

}  // namespace

scaled_stiffness::scaled_stiffness(const long_system& t, std::vector<int> row_of,
                                   std::optional<int> subdiagonals, bool by_columns, bool keeps_proofs)
    : system_(t),
      row_of_(std::move(row_of)),
      dof_at_(row_of_.size()),
      subdiagonals_(subdiagonals),
      by_columns_(!subdiagonals || (by_columns && !keeps_proofs)),
      keeps_proofs_(keeps_proofs) {
  for (std::size_t dof = 0; dof < row_of_.size(); ++dof) dof_at_[row_of_[dof]] = static_cast<int>(dof);
}

/// Calls put(row, column, value) for every entry in the lower triangle of S K_A S - shift I.
template <class Put>
void scaled_stiffness::each_entry(double shift, const Put& put) const {
  for (int dof = 0; dof < static_cast<int>(system_.dofs()); ++dof) {
    const int row = row_of_[dof];
    if (system_.fixed[dof] != 0) {
      put(row, row, double_double(1.0) - shift);
      continue;
    }
    for (const auto& [column, of_true] : system_.stiffness[dof]) {
      if (system_.fixed[column] != 0 || row_of_[column] > row) continue;
      double_double entry = column == dof ? of_true + springs_[dof] : of_true;
      if (const auto between = between_.find({dof, column}); between != between_.end())
        entry += between->second;
      entry = entry * (scale_[dof] * scale_[column]);
      put(row, row_of_[column], column == dof ? entry - shift : entry);
    }
  }
}

template <class Number>
band_of_numbers<Number> scaled_stiffness::band(double shift) const {
  band_of_numbers<Number> all(static_cast<int>(system_.dofs()), *subdiagonals_);
  const auto put = [](Number& entry, const double_double& x) {
    if constexpr (std::is_same_v<Number, double>)
      entry = x.hi;
    else
      entry = x;
  };
  if (narrow_.order() == 0) {
    each_entry(shift, [&](int row, int column, const double_double& x) { put(all.at(row, column), x); });
    return all;
  }
  for (std::size_t i = 0; i < narrow_.entries().size(); ++i) put(all.data()[i], narrow_.data()[i]);
  for (int row = 0; row < all.order(); ++row) put(all.at(row, row), narrow_.at(row, row) - shift);
  return all;
}

sparse_columns scaled_stiffness::columns() const {
  sparse_matrix all{static_cast<int>(system_.dofs()), {}};
  each_entry(0.0, [&all](int row, int column, const double_double& x) {
    all.entries.push_back({row, column, x.hi});
  });
  return columns_of(all);
}

bool scaled_stiffness::factor(std::span<const int> pairs) {
  proof_.reset();
  springs_.assign(system_.dofs(), 0.0);
  between_.clear();
  for (const int i : pairs) {
    if (const int dof = i - static_cast<int>(system_.pairs.size()); dof >= 0) {
      springs_[dof] += system_.stiffness[dof].at(dof);
      continue;
    }
    const long_pair& p = system_.pairs[i];
    springs_[p.dof] += p.stiffness;
    if (p.other < 0) continue;
    springs_[p.other] += p.stiffness;
    between_[{p.dof, p.other}] -= p.stiffness;
    between_[{p.other, p.dof}] -= p.stiffness;
  }
  scale_.assign(system_.dofs(), 1.0);
  for (std::size_t dof = 0; dof < system_.dofs(); ++dof) {
    if (system_.fixed[dof] != 0) continue;
    const double diagonal = system_.root[dof] * system_.root[dof] + springs_[dof].hi;
    scale_[dof] = root_scale(diagonal);
  }
  narrow_ = {};
  if (is_narrow()) narrow_ = band<double_double>(0.0);
  return factor_in_doubles() || factor_in_32_digits();
}

bool scaled_stiffness::factor_in_doubles() {
  long_.reset();
  if (by_columns_) {
    columns_ = columns();
    if (!sparse_) sparse_ = sparse_factor::make(columns_);
    return sparse_->factor(columns_);
  }
  factor_ = band<double>(0.0);
  return contct::factor(factor_);
}

bool scaled_stiffness::factor_in_32_digits() {
  if (!subdiagonals_ || !can_be_factored_long(static_cast<int>(system_.dofs()), *subdiagonals_)) return false;
  long_ = band<double_double>(0.0);
  return contct::factor(*long_);
}

std::vector<double> scaled_stiffness::doubtful_motion() const {
  std::vector<double> motion(system_.dofs());
  if (!long_) return motion;
  const long_vector x = doubtful_motion_in(*long_);
  for (std::size_t dof = 0; dof < motion.size(); ++dof) {
    const double moved = x[row_of_[dof]].hi * scale_[dof];
    if (system_.fixed[dof] == 0 && std::isfinite(moved)) motion[dof] = moved;
  }
  return motion;
}

void scaled_stiffness::solve_rows(std::span<double> x) const {
  if (long_) {
    long_vector y(x.begin(), x.end());
    solve_with(*long_, y);
    std::ranges::transform(y, x.begin(), &double_double::hi);
    return;
  }
  if (sparse_) return sparse_->solve(x);
  contct::solve_with(factor_, x);
}

void scaled_stiffness::solve(std::span<double> b) const {
  std::vector<double> x(b.size());
  for (std::size_t dof = 0; dof < b.size(); ++dof)
    x[row_of_[dof]] = system_.fixed[dof] != 0 ? 0.0 : b[dof] * scale_[dof];
  solve_rows(x);
  for (std::size_t dof = 0; dof < b.size(); ++dof) b[dof] = x[row_of_[dof]] * scale_[dof];
}

long_vector scaled_stiffness::times(std::span<const double_double> x, std::span<double> sizes) const {
  long_vector y(x.size());
  for (std::size_t dof = 0; dof < x.size(); ++dof) y[dof] = springs_[dof] * x[dof];
  for (const auto& [at, spring] : between_) {
    y[at.first] += spring * x[at.second];
    if (!sizes.empty()) sizes[at.first] += std::abs(spring.hi * x[at.second].hi);
  }
  system_.add_product(x, y, sizes);
  return y;
}

/// Estimates the least eigenvalue by two inverse iterations. The estimate is never too small, and seldom more
/// than three times too large.
double scaled_stiffness::least_estimate() const {
  const std::size_t n = system_.dofs();
  std::vector<double> x(n);
  for (std::size_t row = 0; row < n; ++row) {
    // A float, because math libraries differ in the last bit of a double sine.
    const auto sine = static_cast<float>(std::sin(2.3 * static_cast<double>(row)));
    x[row] = system_.fixed[dof_at_[row]] != 0 ? 0.0 : 1.0 + 0.5 * sine;
  }
  double estimate = 1.0;
  for (int i = 0; i < 2; ++i) {
    const double norm = std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0));
    if (!(norm > 0.0)) return 1.0;
    for (double& part : x) part /= norm;
    const std::vector<double> before = x;
    solve_rows(x);
    estimate = 1.0 / std::inner_product(x.begin(), x.end(), before.begin(), 0.0);
  }
  return std::min(estimate, 1.0);
}

/// A narrow band is summed in 32 digits: the bound is smaller, so the proved eigenvalue is larger.
template <class Number>
std::optional<double> scaled_stiffness::error_of_band(double shift) {
  band_of_numbers<Number> l = band<Number>(shift);
  if (!contct::factor(l)) return std::nullopt;
  // NOLINTBEGIN(bugprone-branch-clone): in 32 digits both are one
  const double error = is_narrow() ? largest_row_of_error(band<double_double>(shift), l, long_rounding)
                                   : largest_row_of_error(band<Number>(shift), l, long_rounding);
  // NOLINTEND(bugprone-branch-clone)
  if (keeps_proofs_) proof_ = stiffness_proof{scale_, row_of_, shift, std::move(l)};
  return error;
}

std::optional<double> scaled_stiffness::error_of_columns(double shift) const {
  sparse_columns a = columns_;
  for (int row = 0; row < a.order(); ++row) a.diagonal(row) -= shift;
  const auto l = sparse_->likewise();
  if (!l->factor(a)) return std::nullopt;
  std::size_t most = 0;  // entries of a row; each, at most 1, was rounded to a double, the diagonal twice
  for (const auto& row : system_.stiffness) most = std::max(most, row.size());
  const double rounding = static_cast<double>(most + 1) * (0x1p-53 + long_rounding);
  return largest_row_of_error(reordered(a, l->places()), l->lower()) + rounding;
}

double scaled_stiffness::least_eigenvalue() {
  if (const double mu = proved_below_estimate(); mu > 0.0 || long_) return mu;
  return factor_in_32_digits() ? proved_below_estimate() : 0.0;
}

double scaled_stiffness::proved_below_estimate() {
  const double highest = least_estimate() / 3;
  for (int tries = 0; tries < 3; ++tries) {
    const double shift = std::ldexp(highest, -4 * tries);
    if (!(shift > 0.0)) break;
    const std::optional<double> error = long_         ? error_of_band<double_double>(shift)
                                        : by_columns_ ? error_of_columns(shift)
                                                      : error_of_band<double>(shift);
    if (!error) continue;
    const double mu = (shift - *error) * (1 - 0x1p-50);
    if (mu > 0.0) return mu;
    proof_.reset();
  }
  return 0.0;
}

}  // namespace contct
