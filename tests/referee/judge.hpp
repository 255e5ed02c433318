// Judges the claims of a run about a problem by the exact path.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "contct/exact/path.hpp"
#include "contct/model/problem.hpp"

namespace contct::referee {

/// The ways to run a problem: `contct run --kernels corrected`, the same with `--engine refactor`,
/// `--final-only`, and `--kernels cpp --engine refactor`. Of the last way only certified numbers and digits
/// are judged, because it follows the 1989 rule.
enum class way { default_engine, refactor, final_only, listing };
inline constexpr int ways = 3;  ///< number of ways with the corrected rule, which come first
[[nodiscard]] std::string_view name_of(way w);

/// The errors of a run. `outside`: the error of a number exceeds the proved bound. `beyond`: the error of a
/// number in a certified step exceeds 1e-6 of the largest exact number of its kind in the state or, if this
/// is 0, on the path. `loose`: the proved bounds of a step are too large for a certificate, although its
/// final state is the only equilibrium.
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
  digits,           ///< a step claims over half a digit more than its worst number has
  false_solution,   ///< solved, although there is no equilibrium
  false_mechanism,  ///< no equilibrium is found, although there is one
  refused,          ///< exit status 2, although there is an equilibrium or a mechanism
  other_end,        ///< a cycle, the limit of increments, or a mechanism in another step
  other_events,     ///< events in another order than the exact one, apart from ties
  fallback,         ///< the end of a step is the reference solution's
  exactly,          ///< the end of a step is the exact path's
};
inline constexpr int faults = 17;
[[nodiscard]] std::string_view name_of(fault f);

/// A problem and its exact path.
struct exact_answer {
  explicit exact_answer(const contct::problem& p);

  exact_problem problem;
  exact_path path;
  /// [steps] 1 if the equilibrium at the end of the step has unique displacements
  std::vector<char> unique;
};

/// One error of a run.
struct finding {
  fault what;
  double amount;  ///< error / proved bound; relative error for `beyond`; false digits for `digits`
  std::string words;
};

/// The errors of a run, and the number of compared values.
struct judgement {
  int steps = 0;      ///< steps whose full load both the run and the exact path reach
  int certified = 0;  ///< certified steps among `steps`
  long values = 0;    ///< numbers compared with exact ones
  std::vector<finding> findings;
};

/// Solves `p` and judges the result. If equilibria differ by a rigid-body motion, only forces and reactions
/// are compared.
[[nodiscard]] judgement judge(const problem& p, const exact_answer& exactly, way how);

}  // namespace contct::referee
