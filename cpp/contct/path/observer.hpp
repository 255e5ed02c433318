// The interface for observers of a path.
#pragma once

#include <span>

#include "contct/kernel/call.hpp"

namespace contct {

struct increment {
  int step;                       ///< from 1
  int number;                     ///< within the step, from 1
  double s;                       ///< s_min
  double fraction;                ///< share of the step's load applied so far
  std::span<const event> events;  ///< sorted by pair
  bool snaps = false;             ///< the increment is a rigid-body motion to the next face, at constant load
  std::span<const double> d = {};  ///< D at each pair after the increment [pairs]
  std::span<const int> isep = {};  ///< ISEP after the events [pairs]
  /// Under the 1989 rule, the force of each spring on the structure, summed over increments; otherwise 0
  /// [pairs].
  std::span<const double> pair_force = {};
};

/// Observes a path without changing it.
class observer {
 public:
  virtual ~observer() = default;
  virtual void called(const answered_call& /*c*/) {}  // after a call of the leading kernel
  virtual void incremented(const increment& /*i*/) {}
};

}  // namespace contct
