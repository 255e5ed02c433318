// The path as pictures need it: the whole structure after increments of the path.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace contct::path {

/// What a picture tells apart: at its face are pairs whose gap the listing takes for zero (under EPSGAP),
/// whatever their status: stationary ones, which carry no force worth the name.
enum class pair_state { open, closed, at_face };

[[nodiscard]] pair_state look_of(const contact_pair& p, double w, bool closed);

/// The structure after one increment.
struct frame {
  int at = 0;                    ///< increments since the start of the path; 0: nothing is loaded yet
  int step = 0;                  ///< from 1; 0 before the first
  int number = 0;                ///< of the increment within its step, from 1; 0: there was none
  double fraction = 0.0;         ///< share of the step's load consumed
  double s = 0.0;                ///< of the increment
  bool snaps = false;            ///< the increment was a rigid motion at constant load
  bool step_end = false;         ///< the state that the step ended in, exactly
  bool from_fallback = false;    ///< that came from elsewhere
  bool from_exact_path = false;  ///< from the exact path
  std::vector<event> events = {};
  std::vector<double> displacement = {};    ///< [dofs]
  std::vector<int> isep = {};               ///< [pairs]
  std::vector<double> pair_forces = {};     ///< as force_of has them [pairs]
  std::optional<end_numbers> numbers = {};  ///< of the end of a step

  [[nodiscard]] bool closed(std::size_t pair) const { return isep[pair] == in_contact; }
};

struct frame_limits {
  std::size_t most_frames = 120;          ///< at least 4
  std::size_t most_numbers = 16'000'000;  ///< in all their displacements together; 8 bytes each
  bool refined = true;  ///< false: increments have the digits of one solve, enough for a picture
};

/// Observes a path and keeps frames of it. The path itself knows the pairs' dofs only, so the
/// whole shape is solved for here: all pairs' springs are in K, each at rest where its node stands, and
/// the forces that the pairs exert are loads. So one factor serves every frame, also where the closed
/// pairs alone would not hold the structure. The end of a step is kept as the path itself tells it.
///
/// Where a path is longer than `most_frames`, increments in between are let go of, evenly: first all but
/// every second, then all but every fourth. Ends of steps are let go of last, and likewise.
class frame_keeper final : public observer {
 public:
  /// `s` and what `total_load` refers to must outlive this object. `forces_by_law`: the leader's rule is
  /// not the listing's, and a pair's force is -k (D - c); otherwise it is what the pair has gathered.
  frame_keeper(const linear_structure& s, load_history total_load, bool forces_by_law,
               const frame_limits& limits = {});

  /// Solve for the state after every increment of the path, kept or not.
  void solve_each() { solves_each_ = true; }
  /// The same, and call `visit` with these states and with those in which steps ended. Increments whose state
  /// cannot be solved for are left out.
  void show_each_to(std::function<void(const frame&)> visit) {
    solve_each();
    visit_ = std::move(visit);
  }
  /// The state after the last increment, under solve_each; its displacement is empty where it was not found.
  [[nodiscard]] const frame& latest() const { return latest_; }

  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  /// In the order of the path, the unloaded structure first.
  [[nodiscard]] const std::vector<frame>& frames() const { return frames_; }
  /// Increments of the path, kept or not.
  [[nodiscard]] int increments() const { return increments_; }
  /// Of the increments within a step, one of so many is kept.
  [[nodiscard]] int stride() const { return stride_; }

 private:
  void begin_step(int step) {
    if (step == step_) return;
    step_ = step;
    std::swap(before_, after_);
    std::fill(after_.begin(), after_.end(), 0.0);
    total_load_(step, after_);
  }

  void keep(frame f) {
    frames_.push_back(std::move(f));
    if (frames_.size() > most_frames_) thin();
  }

  /// The path itself tells the state that a step ends in: that one is shown then.
  void show_latest() {
    if (std::exchange(unshown_, false) && visit_) visit_(latest_);
  }

  void thin();
  [[nodiscard]] std::vector<double> shape_after(const increment& i);

  /// Do supports and all pairs together hold the structure? Then the factor is there.
  [[nodiscard]] bool can_be_solved() {
    if (stiffness_ || unsolvable_) return !unsolvable_;
    unsolvable_ = !structure_.is_held(structure_.held_by([](std::size_t) { return true; }));
    if (!unsolvable_) stiffness_.emplace(structure_).factor(std::vector<char>(structure_.pairs.size(), 1));
    return !unsolvable_;
  }

  static constexpr std::size_t fewest_frames = 4;
  const linear_structure& structure_;
  load_history total_load_;
  bool forces_by_law_;
  bool refined_;
  std::size_t most_frames_;
  std::optional<factored_stiffness> stiffness_;  // with the springs of all pairs; made at the first use
  bool unsolvable_ = false;
  std::vector<double> before_, after_;  // total loads at the step's ends [dofs]
  int step_ = 0;
  int increments_ = 0;
  int stride_ = 1, step_stride_ = 1;
  frame last_;  // the last increment, without its shape
  std::vector<frame> frames_;
  std::function<void(const frame&)> visit_;
  bool solves_each_ = false;
  frame latest_;
  bool unshown_ = false;
};

}  // namespace contct::path
