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

enum class path_status {
  solved,           ///< every step's load is applied
  mechanism,        ///< nothing holds the structure, and its load certainly has no equilibrium
  cycle,            ///< toggles repeat for ever without progress
  iteration_limit,  ///< a step took more increments than allowed
  not_factored,     ///< the structure is held, but ill-conditioned or out of range in double precision
  path_ended,       ///< nothing holds the structure, but its load may have an equilibrium
};

struct path_end {
  path_status status = path_status::solved;
  int step = 0;                 ///< the step in which the path ended, from 1
  double fraction = 1.0;        ///< share of this step's load that was reached
  std::vector<int> pairs = {};  ///< from 0; mechanism, path_ended: pairs whose separation was the cause;
                                ///< cycle, iteration_limit: pairs whose events repeat
  engine_counts work = {};
  /// If not solved: true if the step's full load has an equilibrium; nothing if undecided.
  std::optional<bool> has_equilibrium = {};
  bool by_1989_rule = false;  ///< the leader has the 1989 rule
  /// The ends of later steps that start from zero and are not solved.
  std::vector<path_end> others = {};

  /// Records the end of another step. The first step that is not solved decides the status of the path.
  void take(path_end of_step) {
    if (status == path_status::solved)
      *this = std::move(of_step);
    else if (of_step.status != path_status::solved)
      others.push_back(std::move(of_step));
  }
};

/// The loads and face movements along the path.
class load_history {
 public:
  /// Writes the total load at the end of `step` (from 1) to `total` [dofs], which is 0 before. Dofs that
  /// settle get their prescribed displacement instead (add_settlements). If faces move, the load acts on
  /// displacements relative to the faces (count_from_faces).
  using totals = std::function<void(int step, std::span<double> total)>;
  /// The work of the total load on the rigid-body motions, without rounding.
  using works = std::function<rigid_work(int step)>;
  /// True if a step starts from the unloaded structure.
  using restarts = std::function<bool(int step)>;
  /// Adds the movement of the faces at each dof, at the end of `step`, to `moved` [dofs].
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
  /// The movement of faces at the end of a step [dofs]; empty if no step moves a face, or in step 0.
  [[nodiscard]] std::vector<double> moved(int step, std::size_t dofs) const {
    if (!moves_ || step == 0) return {};
    std::vector<double> m(dofs);
    moves_(step, m);
    return m;
  }
  /// The movement of faces at the beginning of a step [dofs]; empty as in `moved`.
  [[nodiscard]] std::vector<double> moved_before(int step, std::size_t dofs) const {
    return moved(from_zero(step) ? 0 : step - 1, dofs);
  }
  /// The work of a step's load; unknown in step 0, or if only rounded loads are given.
  [[nodiscard]] rigid_work work(int step) const { return work_ && step > 0 ? work_(step) : rigid_work(); }
  [[nodiscard]] bool from_zero(int step) const { return step == 1 || (from_zero_ && from_zero_(step)); }

 private:
  totals total_;
  works work_;
  restarts from_zero_;
  moves moves_;
};

struct full_load_state {
  std::vector<double> displacement;         ///< [dofs]
  std::vector<int> isep;                    ///< [pairs]
  std::optional<end_numbers> numbers = {};  ///< present if the state was refined
  bool from_reference = false, from_exact_path = false;
};

/// The result of a search for the equilibrium under the full load of a step.
struct found_end {
  std::optional<full_load_state> state = {};
  std::optional<bool> exists = {};  ///< whether an equilibrium exists; nothing if undecided
};

/// Ends `step` (from 1): refines and proves the state `reached`, which is null if the path failed. Without a
/// proved state, finds the equilibrium by other means.
using end_finder = std::function<found_end(int step, const full_load_state* reached)>;

struct path_limits {
  int increments_per_step = 0;  ///< 0 allows 1000 increments plus 50 for each pair
  /// Ends steps, except under the 1989 rule. Under the 1989 rule, only decides whether a load that the
  /// path did not reach has an equilibrium.
  end_finder ends = nullptr;
};

/// The largest limit of increments in a step.
inline constexpr int most_increments = 1'000'000'000;

/// The limit of increments in a step, at most `most_increments`.
[[nodiscard]] int increments_allowed(const path_limits& limits, std::size_t pairs);

/// Follows the path of `steps` load steps. After a step that is not solved, only steps from zero are
/// followed. `leader` decides about contact, and the policy of its rule makes all other decisions
/// (contct/path/policy.hpp).
///
/// The engine must contain the springs of the pairs that start in contact, and no others.
path_end follow_path(const linear_structure& s, int steps, const load_history& total_load,
                     stiffness_engine& engine, kernel& leader, std::span<observer* const> observers,
                     const path_limits& limits = {});

}  // namespace contct
