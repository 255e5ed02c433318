// Tier 2: kernels in free run, compared by events, shares of the step and D.
#pragma once

#include <string>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"

namespace contct {

/// An event and the share of its step's load at which it happened.
struct timed_event {
  int step;  ///< from 1
  double fraction;
  event what;
};

/// Records the events and states by which free runs are compared.
class path_record final : public observer {
 public:
  void incremented(const increment& i) override {
    for (const event& e : i.events) events.push_back({i.step, i.fraction, e});
  }
  void step_ended(const step_state& s) override {
    displacement.emplace_back(s.displacement.begin(), s.displacement.end());
  }

  std::vector<timed_event> events;
  std::vector<std::vector<double>> displacement;  ///< at the end of each step [steps][dofs]
  path_end end;                                   ///< for the caller to fill in
};

/// How a kernel's own path differs from the leader's. s itself is not compared: it is a small difference of
/// nearby event loads and loses digits even if the shares do not.
struct free_run_difference {
  bool same_end = true;          ///< both ended in the same way, in the same step
  bool same_events = true;       ///< the same pairs made and broke in the same order
  std::string first_difference;  ///< of the ends or events, for people; empty when there is none
  double fraction = 0.0;         ///< largest difference of the share of the step at an event
  double displacement = 0.0;     ///< largest difference of D, relative to the path's largest
  double bound = 0.0;            ///< what `fraction` and `displacement` may reach

  [[nodiscard]] bool within_bound() const {
    return same_end && same_events && fraction <= bound && displacement <= bound;
  }
};

/// The bound between kernels: 1e-9 for one precision and rule, 1e-4 for different ones.
[[nodiscard]] double free_run_bound(const kernel_facts& leader, const kernel_facts& other);

/// Compare two recorded paths of one problem. Deflections, the first of a node's
/// `dofs_per_node` dofs, are measured against the largest of them on the whole path, rotations against the
/// largest of those: they have different units, and an unloaded step has no size of its own.
[[nodiscard]] free_run_difference compare_paths(const path_record& leader, const path_record& other,
                                                double bound, int dofs_per_node);

}  // namespace contct
