// The incremental path of the 1989 paper.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/model/structure.hpp"
#include "contct/path/observer.hpp"
#include "contct/solve/engine.hpp"

namespace contct {

/// The status in which a path ended.
enum class path_status {
  solved,           ///< every step's load is applied
  mechanism,        ///< nothing holds the structure any more, and its load has certainly no equilibrium
  cycle,            ///< the same pairs toggle for ever without progress
  iteration_limit,  ///< a step took more increments than allowed
  not_factored,     ///< held, but too ill-conditioned for double precision, or beyond its range
  path_ended,       ///< nothing holds the structure any more, but its load may have an equilibrium
};

struct path_end {
  path_status status = path_status::solved;
  int step = 0;                 ///< the step in which it ended, from 1
  double fraction = 1.0;        ///< share of that step's load reached
  std::vector<int> pairs = {};  ///< mechanism and path_ended: whose separation led to it; cycle and
                                ///< limit: those whose events repeat; from 0, empty when none did
  engine_counts work = {};      ///< the engine's work
  /// Not solved: has the step's full load an equilibrium? Nothing if that is undecided.
  std::optional<bool> has_equilibrium = {};
  bool by_1989_rule = false;  ///< the leader's
  /// The ends of later steps that were not solved either: each starts from zero.
  std::vector<path_end> others = {};

  /// Records the end of one more step: the first that is not solved decides the status of the path.
  void take(path_end of_step) {
    if (status == path_status::solved)
      *this = std::move(of_step);
    else if (of_step.status != path_status::solved)
      others.push_back(std::move(of_step));
  }
};

/// Loads along the path, and moves of faces.
class load_history {
 public:
  /// Write the total load at the end of `step` (from 1) to `total` [dofs], which comes zeroed; at dofs that
  /// settle, the displacement that is prescribed (add_settlements). Where faces move, of displacements that
  /// are counted from them (count_from_faces).
  using totals = std::function<void(int step, std::span<double> total)>;
  /// The work of that load on the rigid-body motions, without rounding.
  using works = std::function<rigid_work(int step)>;
  /// Does a step start from the unloaded structure, whatever comes before it?
  using restarts = std::function<bool(int step)>;
  /// Add how far the faces at each dof are moved at the end of `step` to `moved` [dofs].
  using moves = std::function<void(int step, std::span<double> moved)>;

  load_history() = default;
  template <class Totals>
  requires std::is_invocable_v<Totals&, int, std::span<double>> load_history(
      Totals total, works work = nullptr,  // NOLINT(google-explicit-constructor): loads, as they are
      restarts from_zero = nullptr, moves moved = nullptr)
      : total_(std::move(total)),
        work_(std::move(work)),
        from_zero_(std::move(from_zero)),
        moves_(std::move(moved)) {}

  void operator()(int step, std::span<double> total) const { total_(step, total); }
  /// Empty if no step moves a face, and in step 0; otherwise [dofs].
  [[nodiscard]] std::vector<double> moved(int step, std::size_t dofs) const {
    if (!moves_ || step == 0) return {};
    std::vector<double> m(dofs);
    moves_(step, m);
    return m;
  }
  /// The same where a step begins.
  [[nodiscard]] std::vector<double> moved_before(int step, std::size_t dofs) const {
    return moved(from_zero(step) ? 0 : step - 1, dofs);
  }
  /// Not known if only rounded loads are given, and in step 0.
  [[nodiscard]] rigid_work work(int step) const { return work_ && step > 0 ? work_(step) : rigid_work(); }
  [[nodiscard]] bool from_zero(int step) const { return step == 1 || (from_zero_ && from_zero_(step)); }

 private:
  totals total_;
  works work_;
  restarts from_zero_;
  moves moves_;
};

/// A state under the full load of a step.
struct full_load_state {
  std::vector<double> displacement;         ///< [dofs]
  std::vector<int> isep;                    ///< [pairs]
  std::optional<end_numbers> numbers = {};  ///< where the state was refined
  bool from_reference = false, from_exact_path = false;
};

/// The equilibrium found under the full load of a step.
struct found_end {
  std::optional<full_load_state> state = {};
  std::optional<bool> exists = {};  ///< nothing: it is not decided
};

/// Ends a step, from 1: refines and proves the state that a path has reached. If that fails, or the path was
/// lost and there is no state (null), it finds the equilibrium by other means.
using end_finder = std::function<found_end(int step, const full_load_state* reached)>;

struct path_limits {
  int increments_per_step = 0;  ///< 0: 1000, and 50 for each pair
  /// Ends the steps of a leader whose rule is not the listing's. With that rule, it tells whether a load that
  /// its path did not reach has an equilibrium.
  end_finder ends = nullptr;
};

/// Most increments of a step that anybody may ask for.
inline constexpr int most_increments = 1'000'000'000;

/// The limit as a number, at most `most_increments`.
[[nodiscard]] int increments_allowed(const path_limits& limits, std::size_t pairs);

/// Follow the path of `steps` load steps, and after one that is not solved only those from zero: `leader`
/// decides, `engine` solves, `observers` watch. What else has to be decided is up to a policy: the 1989
/// driver's for a leader with the 1989 rule, the corrected rule's for any other
/// (contct/path/policy.hpp).
///
/// The engine must be fresh: with the springs of the pairs that start in contact, and no others.
path_end follow_path(const linear_structure& s, int steps, const load_history& total_load,
                     stiffness_engine& engine, kernel& leader, std::span<observer* const> observers,
                     const path_limits& limits = {});

}  // namespace contct
