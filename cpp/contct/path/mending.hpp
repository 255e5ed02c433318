// What the driver adds for a leader whose rule is not the listing's: help where no kernel can give it.
#pragma once

#include <span>
#include <vector>

#include "contct/path/path_state.hpp"
#include "contct/solve/engine.hpp"

namespace contct {

/// Mends a path. For the listing's rule it is off, and the path is left as the 1989 driver has it.
class mending {
 public:
  mending(path_state& state, stiffness_engine& engine, bool on) : state_(state), engine_(engine), on_(on) {}
  [[nodiscard]] bool on() const { return on_; }

  void begin_step();

  /// Where supports and closed pairs leave motions free that the load does not drive, put springs
  /// of open pairs in, at rest where they stand: they hold the structure and have nothing to do.
  /// False when the structure is free all the same. `stand_up` takes them out again.
  bool lean();
  void stand_up();

  /// Add the force that keeps each spring leant on at rest to `load` [dofs].
  void hold_at_rest(std::span<double> load) const;

  /// Look at a call that has been answered. A pair toggled twice running without any progress has a
  /// d* that is rounding: it stays closed, and d* is 0 for it in calls to come until the load
  /// advances. True when that has just happened.
  bool mute(double s_min);

  /// d* as the kernel is to see it [pairs].
  [[nodiscard]] std::span<const double> d_test();

  /// Does every pair stand, under displacement `u` [dofs], on the side of its face that its status
  /// says? An open one may be beyond it by rounding of the largest deflection, a closed one by
  /// rounding of its face.
  [[nodiscard]] bool obeys(std::span<const double> u) const;

  /// Put D on the face of every pair that rounding has carried beyond it.
  void put_on_faces();

 private:
  path_state& state_;
  stiffness_engine& engine_;
  bool on_;
  std::vector<int> leaning_;    // open pairs whose springs are in
  std::vector<int> muted_;      // pairs that are not asked
  int last_at_rest_ = -1;       // the pair toggled last without progress
  std::vector<double> d_test_;  // d* with the muted pairs' 0 [pairs]
};

}  // namespace contct
