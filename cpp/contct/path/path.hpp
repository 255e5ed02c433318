// The incremental path of the 1989 paper.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/linear/engine.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/structure_state.hpp"
#include "contct/structure/structure.hpp"

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
  int step = 0;                  ///< the step in which the path ended, from 1
  double fraction = 1.0;         ///< share of this step's load that was reached
  std::vector<int> pairs = {};   ///< from 0; mechanism, path_ended: pairs whose separation was the cause;
                                 ///< cycle, iteration_limit: pairs whose events repeat
  std::vector<int> opened = {};  ///< from 0: the pairs of the last separation in this step
  engine_counts work = {};
  /// If not solved: true if the step's full load has an equilibrium; nothing if undecided.
  std::optional<bool> has_equilibrium = {};
  bool by_1989_rule = false;  ///< the leader has the 1989 rule
  /// The ends of later steps that start from zero and are not solved.
  std::vector<path_end> others = {};

  /// Sets the final status once it is known whether an equilibrium exists. A path that failed ends in a
  /// mechanism only if certainly no equilibrium exists.
  void conclude() {
    const bool is_mechanism = has_equilibrium == false;
    if (status == path_status::mechanism) {
      if (!is_mechanism) status = path_status::path_ended;
    } else if (is_mechanism && (!by_1989_rule || status == path_status::path_ended)) {
      status = path_status::mechanism;
      if (!by_1989_rule) pairs = opened;
    }
    if (status == path_status::solved || status == path_status::not_factored) has_equilibrium.reset();
  }

  /// Records the end of another step. The first step that is not solved decides the status of the path.
  void take(path_end of_step) {
    if (status == path_status::solved)
      *this = std::move(of_step);
    else if (of_step.status != path_status::solved)
      others.push_back(std::move(of_step));
  }
};

/// The largest limit of increments in a step.
inline constexpr int most_increments = 1'000'000'000;

/// The limit of increments in a step of a problem with `pairs`: `asked` or, if `asked` is 0, 1000 plus 50 for
/// each pair; at most `most_increments`.
[[nodiscard]] int increments_allowed(int asked, std::size_t pairs);

class load_history;
struct path_state;
class path_policy;

/// A path, one load step at a time. `leader` decides about contact, and the policy of its rule makes all
/// other decisions (contct/path/policy.hpp).
class path {
 public:
  /// The engine must contain the springs of the pairs that start in contact, and no others. `max_increments`:
  /// see increments_allowed. All arguments must outlive this object.
  path(const linear_structure& s, const load_history& loads, stiffness_engine& engine, kernel& leader,
       std::span<observer* const> observers, int max_increments = 0);
  ~path();
  path(const path&) = delete;
  path& operator=(const path&) = delete;

  /// Follows the paper's loop until the load of `step`, from 1, is applied or the path ends.
  path_end follow(int step);

  /// The state under the load applied so far. If the structure cannot be held, it has the displacements after
  /// the rigid-body motions. Empty if it is out of range in double precision.
  [[nodiscard]] const std::optional<structure_state>& now() const { return reached_; }

  /// The next step starts from `s`, the end of this step: from the state that was reached or, under other
  /// rules than that of 1989, from a state that is as good or better. Returns the reciprocal condition of the
  /// equilibrated stiffness there; 0 without a factor.
  double go_on_from(const structure_state& s);

 private:
  [[nodiscard]] path_end loop();
  [[nodiscard]] path_end ended(path_status status, std::vector<int> pairs = {}) const;
  [[nodiscard]] path_end set_free();
  void reach();

  int increments_allowed_;
  bool by_1989_rule_;
  std::unique_ptr<path_state> now_;
  std::unique_ptr<path_policy> policy_;
  std::optional<std::vector<int>> reported_;  // statuses after the last increment, if set_free changed them
  std::optional<structure_state> reached_;
  double rcond_ = 0.0;
};

}  // namespace contct
