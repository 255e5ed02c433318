// The statements of a run about a problem, judged by its exact path.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "contct/exact/path.hpp"
#include "contct/model/problem.hpp"

namespace contct::referee {

/// The options of a run: `contct run --kernels corrected`, the same with `--engine refactor`, `--final-only`,
/// and `--kernels cpp --engine refactor`. Of the last one only certified numbers and digits are judged: its
/// path and its end are the 1989 rule's.
enum class way { default_engine, refactor, final_only, listing };
inline constexpr int ways = 3;  ///< the first three, which use the corrected rule
[[nodiscard]] std::string_view name_of(way w);

/// The possible errors of a run. `outside`: a number of a certified step is further off than the tolerance of
/// its certificate, measured as that does: deflections and slopes by the largest that the path has seen, pair
/// forces and reactions by the largest of the path. `beyond`: it is off by more than 1e-6 of the largest of
/// its kind in its own state; a state of no load is measured by the largest of the path. `loose`: the bounds
/// of a step are proved, but are too large to certify it, though it ends in the only equilibrium.
enum class fault {
  outside_deflection,
  outside_slope,
  outside_force,
  outside_reaction,
  beyond_deflection,
  beyond_slope,
  beyond_force,
  beyond_reaction,
  loose,
  digits,           ///< a step claims at least half a digit more than its worst number has
  false_solution,   ///< solved although there is no equilibrium
  false_mechanism,  ///< no equilibrium found although there is one
  refused,          ///< exit 2, though there is an equilibrium or a mechanism
  other_end,        ///< a cycle, the limit of increments, or a mechanism in another step
  other_events,     ///< in another order than exactly, ties aside, of a path that was not lost
  fallback,         ///< the path could not reach the end of a step: its state is the reference solution's
  exactly,          ///< the same, and its state is the end of the exact path
};
inline constexpr int faults = 17;
[[nodiscard]] std::string_view name_of(fault f);

/// A problem and its exact path.
struct exact_answer {
  explicit exact_answer(const contct::problem& p);

  exact_problem problem;
  exact_path path;
  /// [steps] Does the state at the end of a step have the only displacements that are in equilibrium?
  std::vector<char> unique;
};

/// One thing that is wrong.
struct finding {
  fault what;
  double amount;  ///< error over tolerance; of `beyond` the relative error; of `digits` the missing ones
  std::string words;
};

/// The errors of one run, and the number of compared values.
struct judgement {
  int steps = 0;      ///< that reached their load on both paths
  int certified = 0;  ///< of these
  long values = 0;    ///< compared with exact ones
  std::vector<finding> findings;
};

/// Solve `p` and judge what is said. Where equilibria differ by a rigid-body motion, forces and reactions
/// alone are compared.
[[nodiscard]] judgement judge(const problem& p, const exact_answer& exactly, way how);

}  // namespace contct::referee
