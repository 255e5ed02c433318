// CHOLMOD's sparse factor, updated and downdated as springs go in and out. Needs CHOLMOD.
#include "contct/matrix/sparse_factor.hpp"
#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/spring_engine.hpp"

namespace contct::solve {
namespace {

/// Keeps L D L^T of K in an order of little fill. A toggle changes the factor by one column (cholmod_updown);
/// a response is one solve with it. When a check is due, a response is corrected by its residual, and the
/// factor is made anew when that correction is not small.
/// Memory: the factor, and K without its zeros: once more, or twice where it is stored as a band.
class cholmod_engine final : public spring_engine {
 public:
  /// Throws std::logic_error where CHOLMOD is not built in.
  explicit cholmod_engine(const linear_structure& s)
      : spring_engine(s),
        entries_(entries_of_band(s)),
        factor_(sparse_factor::make(
            k().columns(), entries_ ? sparse_factor::kind::updatable_amd : sparse_factor::kind::updatable)) {}
  [[nodiscard]] std::string_view name() const override { return "cholmod"; }

  void respond(const residual_load& residual, std::span<double> d_star) override {
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

  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override {
    remove_updates();
    solve_refined(
        structure_, k(), springs_of(structure_, applied_), [this](std::span<double> b) { solve(b); },
        with_pair_forces(structure_, load, pair_forces), u);
  }

  [[nodiscard]] double reciprocal_condition() override {
    try {
      remove_updates();
    } catch (const no_factor&) {
      return 0.0;
    }
    return contct::matrix::reciprocal_condition(structure_.stiffness,
                                                k().diagonal_with(springs_of(structure_, applied_)),
                                                [this](std::span<double> b) { solve(b); });
  }

 private:
  [[nodiscard]] const stiffness_matrix& k() const { return entries_ ? *entries_ : structure_.stiffness; }
  [[nodiscard]] bool has_updates() const { return counts_.updates != updates_at_factor_; }

  void factor_anew() {
    has_factor_ = false;
    ++counts_.factors;
    if (!factor_->factor(k().diagonal_with(springs_of(structure_, apply_all())))) refuse_ill_conditioned();
    has_factor_ = true;
    updates_at_factor_ = counts_.updates;
    drift_.check_next();
  }

  /// A factor that no update has changed.
  void remove_updates() {
    if (!has_factor_ || applied_ != wanted_ || has_updates()) factor_anew();
  }

  /// L D L^T + sigma k e e^T for one pair. False when a new factor is due.
  [[nodiscard]] bool update(int pair) {
    const int dof = structure_.dof_of_pair(pair);
    if (structure_.fixed[dof] != 0) return true;
    const int row = structure_.row_of(dof);
    const bool closed = applied_[pair] != 0;
    const double stiffness = stiffness_of(pair);
    ++counts_.updates;
    // Removing a spring that is stiffer than the structure cancels digits, so the residual is checked at
    // once.
    if (!closed && stiffness > k().diagonal(row)) drift_.check_next();
    return has_factor_ = factor_->update(row, stiffness, closed);
  }

  void solve(std::span<double> b) {
    factor_->solve(b);
    ++counts_.solves;
  }

  /// Does x still solve K x = b? Corrects it by the residual. The drift found with a new factor is rounding,
  /// and another one would not reduce it.
  [[nodiscard]] bool still_solves(std::span<const double> b, std::span<double> x) {
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

  std::optional<stiffness_matrix> entries_;  // of a band, without its zeros
  std::unique_ptr<sparse_factor> factor_;
  bool has_factor_ = false;
  std::int64_t updates_at_factor_ = 0;
  std::vector<double> increment_;   // by rows
  std::uint64_t increment_is_ = 0;  // which
  double rounding_ = 0.0;           // the drift that a check finds with a new factor
  drift_monitor drift_{{16, 256, 1e-10, 1e-10 / 8}};
};

}  // namespace

std::unique_ptr<stiffness_engine> make_cholmod_engine(const linear_structure& s) {
  return std::make_unique<cholmod_engine>(s);
}

}  // namespace contct::solve
