// The policy of the corrected rule: what no kernel can decide from one call (reference/corrected-rule.md).
#pragma once

#include <span>
#include <vector>

#include "contct/path/cycle_detector.hpp"
#include "contct/path/path.hpp"
#include "contct/path/policy.hpp"

namespace contct::path {

/// Rigid motions that the load drives are followed to the next face at constant load; those that it does not
/// drive are held by springs without force. A pair that toggles twice running without progress stays in
/// contact until the load advances. At the end of a step D is computed from the springs' own law, and what
/// rounding left out of balance is put to the kernel once more. A path that cannot go on ends by `fallback`.
class stabilized_policy final : public path_policy {
 public:
  /// All must outlive this object; `fallback` may be empty.
  stabilized_policy(path_state& now, kernel& leader, cycle_detector& cycles, const fallback_solver& fallback)
      : path_policy(now, leader), cycles_(cycles), fallback_(fallback) {}

  void begin_step() override;
  response respond() override;
  double ask() override;
  bool accept(double& s_min) override;
  [[nodiscard]] bool goes_on() const override { return true; }
  void end_step(int number) override;
  void displace(std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;
  [[nodiscard]] bool can_be_held() override;
  bool fall_back(int step) override;

 private:
  bool add_holding_springs();
  void remove_holding_springs();
  bool keep_in_contact_if_toggled_again(double s_min);
  [[nodiscard]] std::span<const double> d_test();
  [[nodiscard]] bool statuses_agree_with(std::span<const double> u) const;
  void put_overshot_pairs_on_their_faces();
  void put_pairs_at(std::span<const double> u);

  cycle_detector& cycles_;
  const fallback_solver& fallback_;
  bool rigid_ = false;                // the last response
  int at_rest_ = 0;                   // answers in a row with SMIN = 0
  int last_toggled_at_rest_ = -1;     // the pair that the last answer without progress toggled
  std::vector<int> kept_in_contact_;  // pairs that are not asked until the load advances
  std::vector<int> holding_;          // separated pairs whose springs hold the structure for a solve
  std::vector<double> d_test_;        // d* with 0 for the pairs kept in contact [pairs]
};

}  // namespace contct::path
