// One factor for many events: the response at the pairs is updated by one column of the inverse an event.
#pragma once

#include <cstdint>
#include <vector>

#include "contct/solve/drift_monitor.hpp"
#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/inverse_columns.hpp"
#include "contct/solve/spring_engine.hpp"

namespace contct::solve {

/// Keeps x, the response of every pair to the step's whole load increment. When the spring k of pair p goes
/// in (sigma = 1) or out (-1), K' = K + sigma k e e^T, and with c = K^-1 e, a column of the inverse at the
/// pairs (Sherman and Morrison):
///
///     g = sigma k / (1 + sigma k c_p),   x' = x - g x_p c
///
/// `inverse_columns` has the columns. Nothing else costs more than O(pairs) an event.
/// Memory: a factor, and a column of pairs a toggle.
///
/// Updates drift: the drift monitor says when x is checked by one more solve. The factor is made anew when
/// the drift is too large, when the columns cost more than a factor would, or when 1 + sigma k c_p has lost
/// its digits.
class updated_engine final : public spring_engine {
 public:
  /// `dissected`: with CHOLMOD's factor in place of a band's.
  explicit updated_engine(const linear_structure& s, bool dissected = false);
  [[nodiscard]] std::string_view name() const override { return dissected_ ? "dissected" : "updated"; }
  void respond(const residual_load& residual, std::span<double> d_star) override;
  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;
  [[nodiscard]] engine_counts counts() const override;

 private:
  void factor_anew();
  void respond_anew(const residual_load& residual);
  /// Update the response by the toggle of one pair. False when that takes a new factor.
  [[nodiscard]] bool update(int pair, std::span<const double> last_s);
  [[nodiscard]] bool still_solves(std::span<const double> increment);

  bool dissected_;
  factored_stiffness stiffness_;
  inverse_columns columns_;
  bool has_factor_ = false;
  std::size_t most_toggles_;       // between factors
  std::vector<double> response_;   // to the whole increment [pairs]
  std::uint64_t response_to_ = 0;  // which increment
  std::vector<double> work_;       // [dofs]
  drift_monitor drift_;
};

}  // namespace contct::solve
