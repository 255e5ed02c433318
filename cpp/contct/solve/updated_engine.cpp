#include "contct/solve/updated_engine.hpp"

#include <algorithm>
#include <cmath>

namespace contct::solve {
namespace {

// Of the response, relative to the largest: 1e-8 of D is promised.
constexpr double updated_drift_allowed = 1e-11;
constexpr drift_monitor::limits updated_drift_limits = {16, 256, updated_drift_allowed, updated_drift_allowed / 4};
// The least 1 - k c when a stiff spring opens: with less, too many of its digits have cancelled.
constexpr double least_denominator = 1e-2;

/// Columns until their sums cost what a factor costs: c^2 / 2 columns of pairs against n kd^2 / 2. Twice as
/// many, since a factor's products come from the cache and the columns' do not: the total is then least.
std::size_t columns_worth_keeping(double flops_of_factor, std::size_t pairs) {
  const double worth = std::sqrt(2 * flops_of_factor / static_cast<double>(std::max<std::size_t>(pairs, 1)));
  return static_cast<std::size_t>(std::clamp(worth, 8.0, 1000.0));
}

}  // namespace

updated_engine::updated_engine(const linear_structure& s, bool dissected)
    : spring_engine(s),
      dissected_(dissected),
      stiffness_(s, dissected),
      columns_(s, stiffness_),
      most_toggles_(columns_worth_keeping(stiffness_.flops(), s.pairs.size())),
      response_(s.pairs.size()),
      work_(s.dofs()),
      drift_(updated_drift_limits) {}

void updated_engine::respond(const residual_load& residual, std::span<double> d_star) {
  if (!has_factor_) factor_anew();
  if (!apply_switched([&](int pair) { return update(pair, residual.last_s); })) factor_anew();
  if (response_to_ != residual.version) {
    respond_anew(residual);
  } else if (drift_.is_due() && columns_.toggles() > 0 && !still_solves(residual.increment)) {
    factor_anew();
    respond_anew(residual);
  }
  for (std::size_t i = 0; i < d_star.size(); ++i) d_star[i] = residual.share * response_[i];
}

void updated_engine::factor_anew() {
  has_factor_ = false;
  stiffness_.factor(apply_all());
  ++counts_.factors;
  has_factor_ = true;
  columns_.start_anew();
  response_to_ = 0;
}

void updated_engine::respond_anew(const residual_load& residual) {
  std::copy(residual.increment.begin(), residual.increment.end(), work_.begin());
  stiffness_.solve(work_);
  ++counts_.solves;
  gather_at_pairs(structure_, work_, response_);
  columns_.correct(response_);
  response_to_ = residual.version;
}

bool updated_engine::update(int pair, std::span<const double> last_s) {
  if (columns_.toggles() >= most_toggles_) return false;
  const double sigma_k = applied_[pair] != 0 ? stiffness_of(pair) : -stiffness_of(pair);
  const std::span<const double> c = columns_.column(pair, last_s);
  if (!(1.0 + sigma_k * c[pair] > least_denominator)) return false;
  const double factor = columns_.take_in(pair, sigma_k) * response_[pair];
  for (std::size_t i = 0; i < response_.size(); ++i) response_[i] -= factor * c[i];
  ++counts_.updates;
  return true;
}

engine_counts updated_engine::counts() const {
  engine_counts all = counts_;
  all.solves += columns_.passes();
  return all;
}

/// Compares x with the solution of K_0 y = f - sum of sigma k x_p e_p, which is x again.
bool updated_engine::still_solves(std::span<const double> increment) {
  ++counts_.checks;
  std::copy(increment.begin(), increment.end(), work_.begin());
  for (const inverse_columns::toggle& t : columns_.all_toggles())
    work_[structure_.dof_of_pair(t.pair)] -= t.sigma_k * response_[t.pair];
  stiffness_.solve(work_);
  ++counts_.solves;
  drift found;
  for (std::size_t i = 0; i < response_.size(); ++i) {
    const double again = work_[structure_.dof_of_pair(i)];
    found.include(again, again - response_[i]);
  }
  return drift_.accepts(found);
}

void updated_engine::recover(std::span<const double> load, std::span<const double> pair_forces,
                             std::span<double> u) {
  if (!has_factor_ || columns_.toggles() > 0 || applied_ != wanted_) factor_anew();
  apply_all();
  stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
}

double updated_engine::reciprocal_condition() {
  has_factor_ = false;
  response_to_ = 0;
  return stiffness_.reciprocal_condition(wanted_);
}

}  // namespace contct::solve
