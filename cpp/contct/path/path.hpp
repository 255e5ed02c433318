// The incremental path of the 1989 paper.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/path/observer.hpp"
#include "contct/solve/engine.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// How a path ended.
enum class path_status {
  solved,           ///< every step's load is applied
  mechanism,        ///< nothing holds the structure any more: there is no equilibrium
  cycle,            ///< the same pairs toggle for ever at a standstill
  iteration_limit,  ///< a step took more increments than allowed
  not_factored,     ///< held, but too ill-conditioned for double precision, or beyond its range
};

struct path_end {
  path_status status = path_status::solved;
  int step = 0;             ///< the step in which it ended, from 1
  double fraction = 1.0;    ///< share of that step's load reached
  std::vector<int> pairs;   ///< mechanism: whose opening freed the structure; cycle and limit: those
                            ///< that keep toggling; from 0, empty when none did
  engine_counts work = {};  ///< what the engine did
};

/// Loads along the path: write the total load at the end of `step` (from 1) to `total` [dofs],
/// which comes zeroed.
using load_history = std::function<void(int step, std::span<double> total)>;

/// An equilibrium from elsewhere.
struct equilibrium_state {
  std::vector<double> displacement;  ///< [dofs]
  std::vector<char> closed;          ///< [pairs] 1 in contact
};

/// Finds the equilibrium under a step's total load [dofs] when a path that may be mended cannot go
/// on; nothing where there is none.
using fallback_solver = std::function<std::optional<equilibrium_state>(std::span<const double> load)>;

struct path_limits {
  int increments_per_step = 0;         ///< 0: 1000, and 50 for each pair
  fallback_solver fallback = nullptr;  ///< used only when the leader's rule is not the listing's
};

/// Most increments of a step that anybody may ask for.
inline constexpr int most_increments = 1'000'000'000;

/// The limit as a number, at most `most_increments`.
[[nodiscard]] int increments_allowed(const path_limits& limits, std::size_t pairs);

/// Follow the path of `steps` load steps: `leader` decides, `engine` solves, `observers` watch.
/// One decision is not the leader's: events within rounding of the step's full load (eps / rcond of
/// it, from 1e-9 to 1e-6) are left undone, as the listing leaves one at s = 1.
///
/// A leader with another rule than the listing's has more help from the driver: a free motion that the
/// load drives is followed to the next face at constant load (a rigid snap), and one that it does
/// not drive is held where it stands; a pair toggled twice running at a standstill is kept closed
/// until the load advances; and at a step's end D is put where the springs' law has it, with what
/// rounding left out of balance put to the kernel once more.
///
/// The engine must be fresh: the springs of the pairs that start closed in, all others out.
path_end follow_path(const linear_structure& s, int steps, const load_history& total_load,
                     stiffness_engine& engine, kernel& leader, std::span<observer* const> observers,
                     const path_limits& limits = {});

}  // namespace contct
