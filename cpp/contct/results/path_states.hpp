// The states of the whole structure along a recorded path, for pictures and tables.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "contct/linear/factored_stiffness.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/results/run_result.hpp"

namespace contct {

/// A state on a path: after an increment, or at the end of a step.
struct path_moment {
  const solved_step* step;
  const increment_record* increment;  ///< null: the step ended without an increment, or by a fallback
  bool is_end;                        ///< true: the state that the path reported for the end of a step
  int at;                             ///< number of increments since the start of the path
};

/// The states of a path in order. A step's last increment and end are one entry, unless a fallback ended it.
[[nodiscard]] std::vector<path_moment> moments_of(const run_result& r);

/// Increments up to this share of a step are its beginning, where pairs separate that only touch their faces.
inline constexpr double first_load = 1e-12;

/// Finds the states at moments of a path whose recorder keeps states. A recorder keeps only D and the forces
/// at the pairs of an increment, so the other displacements are solved for: K contains the springs of all
/// pairs, each undeformed at the D of its pair, and the forces of the pairs are loads. One factor then serves
/// every state, even a state whose pairs in contact do not hold the structure.
class path_states {
 public:
  /// `r` must outlive this object.
  explicit path_states(const run_result& r);

  /// The state at `m`. Within a step, it has no displacement if supports and pairs cannot hold the structure.
  [[nodiscard]] structure_state at(const path_moment& m);

 private:
  void begin_step(int step);
  [[nodiscard]] std::vector<double> shape_after(const increment_record& i);
  [[nodiscard]] bool can_be_solved();

  const run_result& run_;
  const linear_structure& structure_;
  load_history total_load_;
  std::optional<factored_stiffness> stiffness_;  // with the springs of all pairs; empty until used
  bool unsolvable_ = false;
  std::vector<double> before_, after_;  // total loads at the start and end of the step [dofs]
  int step_ = 0;
};

inline constexpr std::size_t most_pictures = 120;

/// The most bytes of all states within steps on a page; the page has no such states if one has more bytes.
inline constexpr std::size_t most_bytes_of_page = 6'000'000;

/// The approximate size of a state as text.
[[nodiscard]] std::size_t bytes_of_state(const problem& p);

/// The states for pictures: the unloaded structure, then states along the path, at most `most`. Five states
/// or more have at most `most_numbers` displacements in total.
[[nodiscard]] std::vector<structure_state> pictures_of(const run_result& r, std::size_t most = most_pictures,
                                                       std::size_t most_numbers = 16'000'000);

}  // namespace contct
