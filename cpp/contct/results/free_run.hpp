// Compares kernels in free run, in which each kernel follows its own path, by events, shares of the step,
// and D.
#pragma once

#include <string>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/results/recorded_path.hpp"

namespace contct {

/// An event, and the share of the step at the event.
struct timed_event {
  int step;  ///< from 1
  double fraction;
  event what;
};

/// The events of a recorded path, in order.
[[nodiscard]] std::vector<timed_event> events_of(const run_recorder& path);

/// The difference between the paths of the leader and of another kernel. The scale factors s are not
/// compared: s is a small difference of nearby event loads, and loses digits even if the shares do not.
struct free_run_difference {
  bool same_end = true;          ///< equal status and step at the ends of the paths
  bool same_events = true;       ///< equal makes and breaks in equal order
  std::string first_difference;  ///< describes the first difference of ends or events; empty without one
  double fraction = 0.0;         ///< largest difference of the share of the step at an event
  double displacement = 0.0;     ///< largest difference of D, relative to the largest D of the path
  double bound = 0.0;            ///< the largest allowed `fraction` and `displacement`

  [[nodiscard]] bool within_bound() const {
    return same_end && same_events && fraction <= bound && displacement <= bound;
  }
};

/// The bound for two kernels: 1e-9 if precision and rule are equal, otherwise 1e-4.
[[nodiscard]] double free_run_bound(const kernel_facts& leader, const kernel_facts& other);

/// Compares two recorded paths of one problem. The first of a node's `dofs_per_node` dofs is a deflection,
/// the others are rotations. A difference of deflections is relative to the largest deflection of the whole
/// path, and a difference of rotations to the largest rotation, because all displacements of a single step
/// without load can be rounding.
[[nodiscard]] free_run_difference compare_paths(const recorded_path& leader, const recorded_path& other,
                                                double bound, int dofs_per_node);

}  // namespace contct
