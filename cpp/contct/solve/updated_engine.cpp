#include "contct/solve/updated_engine.hpp"

#include <algorithm>
#include <cmath>

namespace contct {
namespace {

constexpr int first_check = 16;
constexpr int longest_between_checks = 256;
constexpr double drift_allowed = 1e-11;  // of the response, relative to the largest: 1e-8 of D is promised
constexpr double digits_kept = 1e-2;  // of 1 in 1 - k c: less, and a stiff spring opens: a new factor is due

/// Columns until their sums cost what a factor costs: c^2 / 2 columns of pairs against n kd^2 / 2, twice as
/// many, since a factor's products come from the cache and the columns' do not. Together they are then least.
std::size_t columns_worth_keeping(double flops_of_factor, std::size_t pairs) {
  const double worth = std::sqrt(2 * flops_of_factor / static_cast<double>(std::max<std::size_t>(pairs, 1)));
  return static_cast<std::size_t>(std::clamp(worth, 8.0, 1000.0));
}

}  // namespace

updated_engine::updated_engine(const linear_structure& s, bool dissected)
    : structure_(s),
      dissected_(dissected),
      pairs_(s.pairs.size()),
      wanted_(pairs_),
      applied_(pairs_),
      stiffness_(s, dissected),
      columns_(s, stiffness_),
      most_toggles_(columns_worth_keeping(stiffness_.flops(), pairs_)),
      response_(pairs_),
      work_(static_cast<std::size_t>(s.dofs())),
      until_check_(first_check),
      check_every_(first_check) {
  for (std::size_t i = 0; i < pairs_; ++i) wanted_[i] = s.pairs[i].closed ? 1 : 0;
}

void updated_engine::switch_spring(int pair, bool closed) {
  wanted_[static_cast<std::size_t>(pair)] = closed ? 1 : 0;
  switched_.push_back(pair);
}

void updated_engine::gather(std::span<const double> at_dofs, std::span<double> at_pairs) const {
  for (std::size_t i = 0; i < pairs_; ++i)
    at_pairs[i] = at_dofs[static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)))];
}

void updated_engine::respond(const residual_load& residual, std::span<double> d_star) {
  if (!has_factor_) factor_anew();
  if (!take_in_switched(residual.last_s)) factor_anew();
  switched_.clear();
  if (response_to_ != residual.version) {
    respond_anew(residual.increment);
    response_to_ = residual.version;
  } else if (--until_check_ <= 0 && columns_.toggles() > 0 && !still_solves(residual.increment)) {
    factor_anew();
    respond_anew(residual.increment);
    response_to_ = residual.version;
  }
  for (std::size_t i = 0; i < pairs_; ++i) d_star[i] = residual.share * response_[i];
}

/// What closes first, then what opens: the structure is held all the while. False when a factor is due.
bool updated_engine::take_in_switched(std::span<const double> last_s) {
  for (const char closed : {char{1}, char{0}}) {
    for (const int pair : switched_) {
      const auto p = static_cast<std::size_t>(pair);
      if (wanted_[p] != closed || applied_[p] == closed) continue;
      if (columns_.toggles() >= most_toggles_ || !take_in(pair, last_s)) return false;
    }
  }
  return true;
}

void updated_engine::factor_anew() {
  has_factor_ = false;
  stiffness_.factor(wanted_);
  ++counts_.factors;
  has_factor_ = true;
  applied_ = wanted_;
  columns_.start_anew();
  response_to_ = 0;
}

void updated_engine::respond_anew(std::span<const double> increment) {
  std::copy(increment.begin(), increment.end(), work_.begin());
  stiffness_.solve(work_);
  ++counts_.solves;
  gather(work_, response_);
  columns_.correct(response_);
}

bool updated_engine::take_in(int pair, std::span<const double> last_s) {
  const auto p = static_cast<std::size_t>(pair);
  const double k = structure_.pairs[p].stiffness;
  const double sigma_k = wanted_[p] != 0 ? k : -k;
  const std::span<const double> c = columns_.column(pair, last_s);
  if (!(1.0 + sigma_k * c[p] > digits_kept)) return false;
  const double much = columns_.take_in(pair, sigma_k) * response_[p];
  for (std::size_t i = 0; i < pairs_; ++i) response_[i] -= much * c[i];
  applied_[p] = wanted_[p];
  ++counts_.updates;
  return true;
}

engine_counts updated_engine::counts() const {
  engine_counts all = counts_;
  all.solves += columns_.passes();
  return all;
}

/// Put the response back into the equations: K_0 x = f - sum of sigma k x_p e_p is what it must satisfy. What
/// is left over sets when to look again.
bool updated_engine::still_solves(std::span<const double> increment) {
  ++counts_.checks;
  std::copy(increment.begin(), increment.end(), work_.begin());
  for (const inverse_columns::toggle& c : columns_.all_toggles()) {
    work_[static_cast<std::size_t>(structure_.dof_of_pair(c.pair))] -=
        c.sigma_k * response_[static_cast<std::size_t>(c.pair)];
  }
  stiffness_.solve(work_);
  ++counts_.solves;
  double size = 0.0;
  double off = 0.0;
  for (std::size_t i = 0; i < pairs_; ++i) {
    const double again = work_[static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)))];
    size = std::max(size, std::abs(again));
    off = std::max(off, std::abs(again - response_[i]));
  }
  const bool good = off <= drift_allowed * size;
  if (!good) check_every_ = std::max(check_every_ / 2, 4);
  if (off < drift_allowed / 4 * size) check_every_ = std::min(2 * check_every_, longest_between_checks);
  until_check_ = check_every_;
  return good;
}

void updated_engine::recover(std::span<const double> load, std::span<const double> pair_forces,
                             std::span<double> u) {
  if (!has_factor_ || columns_.toggles() > 0 || applied_ != wanted_) factor_anew();
  switched_.clear();
  stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
}

double updated_engine::reciprocal_condition() {
  has_factor_ = false;
  response_to_ = 0;
  return stiffness_.reciprocal_condition(wanted_);
}

}  // namespace contct
