// The states of the whole structure along a recorded path, for everything that draws or lists them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "contct/session/run_result.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace contct {

/// A state that a path went through: behind an increment, or at the end of a step.
struct path_moment {
  const step_record* step;
  const increment_record* increment;  ///< null: the step ended without one, or in the state of a fallback
  bool is_end;                        ///< what the path itself tells of the step's end
  int at;                             ///< increments since the start of the path
};

/// The states in the order of the path. The last increment of a step and the step's end are one entry.
[[nodiscard]] std::vector<path_moment> moments_of(const run_result& r);

/// Up to this share a step has only begun: structures that rest on their faces separate at once.
inline constexpr double first_load = 1e-12;
/// Of the increments up to `first_load` of a step, only the last one is kept.
[[nodiscard]] std::vector<path_moment> without_first_moves(std::vector<path_moment> all);

/// Of too many the increments are left out evenly: first all but every second, then all but every fourth; and
/// ends of steps likewise, where these are more than half of all. The last moment stays.
[[nodiscard]] std::vector<path_moment> thinned(std::vector<path_moment> all, std::size_t most);

/// Finds the states at moments of a path whose recorder keeps states. The path itself knows the pairs' dofs
/// only, so the whole shape is solved for here: all pairs' springs are in K, each at rest where its node
/// stands, and the forces that the pairs exert are loads. So one factor serves every state, also where the
/// pairs in contact alone would not hold the structure.
class path_states {
 public:
  /// `r` must outlive this object.
  explicit path_states(const run_result& r);

  /// Its displacement is empty where even all pairs together do not hold the structure.
  [[nodiscard]] structure_state at(const path_moment& m);

 private:
  void begin_step(int step);
  [[nodiscard]] std::vector<double> shape_after(const increment_record& i);
  [[nodiscard]] bool can_be_solved();

  const run_result& run_;
  const linear_structure& structure_;
  load_history total_load_;
  std::optional<factored_stiffness> stiffness_;  // with the springs of all pairs; made at the first use
  bool unsolvable_ = false;
  std::vector<double> before_, after_;  // total loads at the step's ends [dofs]
  int step_ = 0;
};

inline constexpr std::size_t most_pictures = 120;

/// The states within steps that a page has take no more bytes than this; so a larger state is in no page.
inline constexpr std::size_t most_bytes_of_page = 6'000'000;

/// About what a state takes as text.
[[nodiscard]] std::size_t bytes_of_state(const problem& p);

/// The states that pictures show: the unloaded structure, and those along the path, no more than `most` and
/// no more than `most_numbers` displacements together.
[[nodiscard]] std::vector<structure_state> pictures_of(const run_result& r, std::size_t most = most_pictures,
                                                       std::size_t most_numbers = 16'000'000);

}  // namespace contct
