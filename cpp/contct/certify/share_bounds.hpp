// How far off the share of a step can be at which an event is said to happen (reference/certificate.md,
// "Events").
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "contct/certify/error_bounds.hpp"
#include "contct/certify/reference_solution.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"

namespace contct::certify {

/// Proves the statuses of pairs shortly before and after their events. The equilibrium moves continuously
/// with the load as long as it is the only one, so that a pair whose two statuses differ has toggled between.
class share_prover {
 public:
  /// All must outlive this object.
  share_prover(const linear_structure& s, const load_history& total_load, error_prover& prover);

  /// Every event of the increment happens within this distance of its share of the step's load, where the end
  /// of the step before counts as share 0: the least of a few distances that is proved. 0 where the increment
  /// ends its step without an event. Nothing where nothing is proved.
  [[nodiscard]] std::optional<double> bound(const path::increment& i);
  /// Of the last bound that was not 0; none of sparse factors, or where nothing was proved.
  [[nodiscard]] std::optional<share_proof> take_proof() { return std::exchange(proof_, std::nullopt); }

 private:
  [[nodiscard]] std::vector<int> statuses_at(int step, double share);
  [[nodiscard]] std::vector<int> statuses_under_load(int step, double share);

  const linear_structure& structure_;
  const load_history& total_load_;
  error_prover& prover_;
  reference_solver reference_;
  std::vector<int> at_first_;                // statuses [pairs]
  std::optional<status_proof> of_statuses_;  // of the last statuses_at
  std::optional<share_proof> proof_;
};

}  // namespace contct::certify
