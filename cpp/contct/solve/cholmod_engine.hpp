// CHOLMOD's sparse factor, updated and downdated as springs go in and out. Needs CHOLMOD.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "contct/matrix/sparse_factor.hpp"
#include "contct/solve/drift_monitor.hpp"
#include "contct/solve/spring_engine.hpp"

namespace contct::solve {

/// Keeps L D L^T of K in an order of little fill. A toggle changes the factor by one column (cholmod_updown);
/// a response is one solve with it. When a check is due, a response is corrected by its residual, and the
/// factor is made anew when that correction is not small.
/// Memory: the factor, and K without its zeros: once more, or twice where it is stored as a band.
class cholmod_engine final : public spring_engine {
 public:
  /// Throws std::logic_error where CHOLMOD is not built in.
  explicit cholmod_engine(const linear_structure& s);
  [[nodiscard]] std::string_view name() const override { return "cholmod"; }
  void respond(const residual_load& residual, std::span<double> d_star) override;
  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;

 private:
  [[nodiscard]] const stiffness_matrix& k() const { return entries_ ? *entries_ : structure_.stiffness; }
  [[nodiscard]] bool has_updates() const { return counts_.updates != updates_at_factor_; }
  void factor_anew();
  void remove_updates();
  [[nodiscard]] bool update(int pair);
  void solve(std::span<double> b);
  [[nodiscard]] bool still_solves(std::span<const double> b, std::span<double> x);

  std::optional<stiffness_matrix> entries_;  // of a band, without its zeros
  std::unique_ptr<sparse_factor> factor_;
  bool has_factor_ = false;
  std::int64_t updates_at_factor_ = 0;
  std::vector<double> increment_;   // by rows
  std::uint64_t increment_is_ = 0;  // which
  double rounding_ = 0.0;           // the drift that a check finds with a new factor
  drift_monitor drift_;
};

}  // namespace contct::solve
