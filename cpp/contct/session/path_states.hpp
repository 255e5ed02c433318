// The states of the whole structure along a recorded path, for pictures and tables.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "contct/session/run_result.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace contct {

/// A state on a path: after an increment, or at the end of a step.
struct path_moment {
  const step_record* step;
  const increment_record* increment;  ///< null: the step ended without one, or by a fallback
  bool is_end;                        ///< true: the state that the path reported for the end of a step
  int at;                             ///< number of increments since the start of the path
};

/// The states in the order of the path. The last increment of a step and the step's end are one entry.
[[nodiscard]] std::vector<path_moment> moments_of(const run_result& r);

/// The share of a step that counts as its beginning, when structures separate from their faces.
inline constexpr double first_load = 1e-12;
/// Removes all but the last of the increments up to `first_load` of each step.
[[nodiscard]] std::vector<path_moment> without_first_moves(std::vector<path_moment> all);

/// Keeps every second increment, then every fourth, and so on, until at most `most` moments are left. Ends of
/// steps are thinned likewise if they are more than half of `most`. The last moment stays.
[[nodiscard]] std::vector<path_moment> thinned(std::vector<path_moment> all, std::size_t most);

/// Finds the states at moments of a path whose recorder keeps states. The path has displacements only at the
/// dofs of pairs, so the shape of the structure is solved for: K contains the springs of all pairs, each
/// undeformed at the displacement of its pair, and the forces of the pairs are loads. One factor then serves
/// every state, even if the pairs in contact alone would not hold the structure.
class path_states {
 public:
  /// `r` must outlive this object.
  explicit path_states(const run_result& r);

  /// The state at a moment. Its displacement is empty if even all pairs together do not hold the structure.
  [[nodiscard]] structure_state at(const path_moment& m);

 private:
  void begin_step(int step);
  [[nodiscard]] std::vector<double> shape_after(const increment_record& i);
  [[nodiscard]] bool can_be_solved();

  const run_result& run_;
  const linear_structure& structure_;
  load_history total_load_;
  std::optional<factored_stiffness> stiffness_;  // contains the springs of all pairs; made at the first use
  bool unsolvable_ = false;
  std::vector<double> before_, after_;  // total loads at the start and end of the step [dofs]
  int step_ = 0;
};

inline constexpr std::size_t most_pictures = 120;

/// A page has states within steps up to this number of bytes in total, and none if one state is larger.
inline constexpr std::size_t most_bytes_of_page = 6'000'000;

/// The approximate size of a state as text.
[[nodiscard]] std::size_t bytes_of_state(const problem& p);

/// The states for pictures: the unloaded structure, and at most `most` states along the path, with at most
/// `most_numbers` displacements in total.
[[nodiscard]] std::vector<structure_state> pictures_of(const run_result& r, std::size_t most = most_pictures,
                                                       std::size_t most_numbers = 16'000'000);

}  // namespace contct
