// Judges the claims of a run about a problem by the exact path, and draws problems that are hard for double
// precision.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/path.hpp"
#include "contct/structure/problem.hpp"

namespace contct::referee {

/// The ways to run a problem: `contct run --kernels corrected`, the same with `--engine refactor`,
/// `--final-only`, and
/// `--kernels cpp --engine refactor`. Of the last way only certified numbers and digits are judged, because
/// it follows the 1989 rule.
enum class way { default_engine, refactor, final_only, listing };
inline constexpr const char* way_names[] = {"default-engine", "refactor", "final-only", "1989-rule"};
inline constexpr int ways = 3;  ///< number of ways with the corrected rule, which come first

/// The errors of a run.
enum class fault {
  outside,  ///< the error of a number exceeds the proved bound
  beyond,   ///< the error of a certified number exceeds 1e-6 of the largest number of its kind in the state
  loose,    ///< no certificate, for too large bounds, although the state is the only equilibrium
  digits,   ///< a step claims over half a digit more than its worst number has
  false_solution,   ///< solved, although there is no equilibrium
  false_mechanism,  ///< no equilibrium is found, although there is one
  refused,          ///< exit status 2, although there is an equilibrium or a mechanism
  other_end,        ///< a cycle, the limit of increments, or a mechanism in another step
  other_events,     ///< events in another order than the exact one, apart from ties
  fallback,         ///< the end of a step is the reference solution's
  exactly,          ///< the end of a step is the exact path's
};
inline constexpr const char* fault_names[] = {"outside", "beyond",     "loose",   "digits",
                                              "solved!", "mechanism!", "refused", "other-end",
                                              "events",  "fallback",   "exactly"};
inline constexpr int faults = std::size(fault_names);

/// A problem and its exact path.
struct exact_answer {
  explicit exact_answer(const contct::problem& p);

  exact_problem problem;
  exact_path path;
  /// [steps] 1 if the equilibrium at the end of the step has unique displacements
  std::vector<char> unique;
};

struct finding {
  fault what;
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

/// Judges what is proved about the mesh of a random beam on beds: the numbers of two meshes must not differ
/// by more than both bounds. `certified` counts the proved steps.
[[nodiscard]] judgement judge_meshes(std::uint64_t number);

inline constexpr int hard_kinds = 9;

/// Returns problem `number` of `seed` of a hard kind, from 0. Its title names the kind. Problems are the same
/// on every machine. Every number has at most 15 decimal digits, so that a file gives exactly the number of
/// the double.
[[nodiscard]] problem make_hard_problem(std::uint64_t seed, std::uint64_t number, int kind);

}  // namespace contct::referee
