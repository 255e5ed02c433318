// One factor for many events: the response at the pairs is updated by one column of the inverse an event.
#pragma once

#include <cstdint>
#include <vector>

#include "contct/solve/engine.hpp"
#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/inverse_columns.hpp"

namespace contct {

/// Keeps x, the response of every pair to the step's whole load increment. When the spring k of pair p goes
/// in (sigma = 1) or out (-1), K' = K + sigma k e e^T, and with c = K^-1 e, a column of the inverse at the
/// pairs (Sherman and Morrison):
///
///     g = sigma k / (1 + sigma k c_p),   x' = x - g x_p c
///
/// `inverse_columns` has the columns. Nothing else costs more than O(pairs) an event.
/// Memory: a factor, and a column of pairs a toggle.
///
/// Updates drift: on a schedule that the drift itself sets, x is put back into the equations by one more
/// solve; and the factor is made anew when too much is left over, when the columns cost more than it would,
/// or when 1 + sigma k c_p has lost its digits.
class updated_engine final : public stiffness_engine {
 public:
  /// `dissected`: over CHOLMOD's factor in place of a band's.
  explicit updated_engine(const linear_structure& s, bool dissected = false);
  [[nodiscard]] std::string_view name() const override { return dissected_ ? "dissected" : "updated"; }
  void switch_spring(int pair, bool closed) override;
  void respond(const residual_load& residual, std::span<double> d_star) override;
  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;
  [[nodiscard]] engine_counts counts() const override;

 private:
  void factor_anew();
  void respond_anew(std::span<const double> increment);
  bool take_in_switched(std::span<const double> last_s);
  /// Take in the toggle of one pair. False when that must be done by a new factor.
  bool take_in(int pair, std::span<const double> last_s);
  [[nodiscard]] bool still_solves(std::span<const double> increment);
  void gather(std::span<const double> at_dofs, std::span<double> at_pairs) const;

  const linear_structure& structure_;
  bool dissected_;
  std::size_t pairs_;
  std::vector<char> wanted_;   // closed, as switched [pairs]
  std::vector<char> applied_;  // closed, in factor and toggles [pairs]
  std::vector<int> switched_;  // pairs that may differ
  factored_stiffness stiffness_;
  inverse_columns columns_;
  bool has_factor_ = false;
  std::size_t most_toggles_;       // between factors
  std::vector<double> response_;   // to the whole increment [pairs]
  std::uint64_t response_to_ = 0;  // which increment
  std::vector<double> work_;       // [dofs]
  int until_check_, check_every_;
  engine_counts counts_;
};

}  // namespace contct
