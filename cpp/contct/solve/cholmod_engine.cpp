#include "contct/solve/cholmod_engine.hpp"

#include <algorithm>

#include "contct/solve/factored_stiffness.hpp"

namespace contct::solve {
namespace {

constexpr double cholmod_drift_allowed = 1e-10;  // of the response, relative to the largest
constexpr drift_monitor::limits cholmod_drift_limits = {16, 256, cholmod_drift_allowed, cholmod_drift_allowed / 8};

}  // namespace

cholmod_engine::cholmod_engine(const linear_structure& s)
    : spring_engine(s),
      entries_(entries_of_band(s)),
      factor_(sparse_factor::make(
          k().columns(), entries_ ? sparse_factor::kind::updatable_amd : sparse_factor::kind::updatable)),
      drift_(cholmod_drift_limits) {}

void cholmod_engine::factor_anew() {
  has_factor_ = false;
  ++counts_.factors;
  if (!factor_->factor(k().diagonal_with(springs_of(structure_, apply_all())))) refuse_ill_conditioned();
  has_factor_ = true;
  updates_at_factor_ = counts_.updates;
  drift_.check_next();
}

/// A factor that no update has changed.
void cholmod_engine::remove_updates() {
  if (!has_factor_ || applied_ != wanted_ || has_updates()) factor_anew();
}

/// L D L^T + sigma k e e^T for one pair. False when a new factor is due.
bool cholmod_engine::update(int pair) {
  const int dof = structure_.dof_of_pair(pair);
  if (structure_.fixed[dof] != 0) return true;
  const int row = structure_.row_of(dof);
  const bool closed = applied_[pair] != 0;
  const double stiffness = stiffness_of(pair);
  ++counts_.updates;
  // Removing a spring that is stiffer than the structure cancels digits, so the residual is checked at once.
  if (!closed && stiffness > k().diagonal(row)) drift_.check_next();
  return has_factor_ = factor_->update(row, stiffness, closed);
}

void cholmod_engine::solve(std::span<double> b) {
  factor_->solve(b);
  ++counts_.solves;
}

void cholmod_engine::respond(const residual_load& residual, std::span<double> d_star) {
  if (!has_factor_ || !apply_switched([this](int pair) { return update(pair); })) factor_anew();
  if (increment_is_ != residual.version || residual.version == 0) {
    increment_ = in_rows(structure_, residual.increment);
    increment_is_ = residual.version;
  }
  std::vector<double> x = increment_;
  solve(x);
  if (drift_.is_due() && !still_solves(increment_, x)) {
    factor_anew();
    x = increment_;
    solve(x);
  }
  for (std::size_t i = 0; i < d_star.size(); ++i)
    d_star[i] = residual.share * x[structure_.row_of(structure_.dof_of_pair(i))];
}

/// Does x still solve K x = b? Corrects it by the residual. The drift found with a new factor is rounding,
/// and another one would not reduce it.
bool cholmod_engine::still_solves(std::span<const double> b, std::span<double> x) {
  ++counts_.checks;
  std::vector<double> correction = residual(k(), springs_of(structure_, applied_), b, x);
  solve(correction);
  drift found;
  for (std::size_t i = 0; i < applied_.size(); ++i) {
    const int row = structure_.row_of(structure_.dof_of_pair(i));
    found.include(x[row], correction[row]);
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i];
  if (!has_updates()) rounding_ = found.relative();
  return drift_.accepts(found, 8 * rounding_);
}

void cholmod_engine::recover(std::span<const double> load, std::span<const double> pair_forces,
                             std::span<double> u) {
  remove_updates();
  solve_refined(
      structure_, k(), springs_of(structure_, applied_), [this](std::span<double> b) { solve(b); },
      with_pair_forces(structure_, load, pair_forces), u);
}

double cholmod_engine::reciprocal_condition() {
  try {
    remove_updates();
  } catch (const no_factor&) {
    return 0.0;
  }
  return contct::matrix::reciprocal_condition(structure_.stiffness,
                                              k().diagonal_with(springs_of(structure_, applied_)),
                                              [this](std::span<double> b) { solve(b); });
}

}  // namespace contct::solve
