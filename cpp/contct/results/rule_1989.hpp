// Follows the path of the 1989 rule, with FORTRAN and C++ in lockstep, after a run of the corrected rule,
// whose result is the answer. Compares the two paths: which events differ, and which states are wrong.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contct/proof/allowed_errors.hpp"
#include "contct/results/run.hpp"

namespace contct {

/// The kernels of the 1989 rule in a run of both rules; the first one leads.
inline const std::vector<std::string> kernels_of_1989 = {"fortran", "cpp"};

/// An event that the two paths do not have at the same share of the step.
struct other_event {
  event what = {};
  std::optional<double> at;  ///< share in the 1989 path; empty: the 1989 path has no such event in this step
};

/// Compares the 1989 path with one increment of the answer.
struct row_of_1989 {
  std::vector<other_event> otherwise = {};  ///< the events that differ
  bool reached = true;                      ///< false: the 1989 path ended before this increment
  bool followed = true;                     ///< false: the 1989 rule was not followed in this combination
};

/// The number in which the end of a step by the 1989 rule differs most from the answer, beyond the error of
/// the answer and, if a difference is not negligible, the rounding of doubles.
struct state_difference {
  int step;                         ///< from 1
  quantity what = quantity::w;      ///< kind of the number
  std::string at = {};              ///< place: "pair 3", "node 5", "the support at node 1", "element 2"
  double value = 0.0, right = 0.0;  ///< the number by the 1989 rule, and in the answer
  double share = 0.0;               ///< the difference, relative to the largest number of the kind
  bool but_for_rounding = false;    ///< larger differences are the rounding of doubles, and are not counted

  [[nodiscard]] bool is_wrong() const { return !(share <= certified_share); }
};

struct rule_1989 : recorded_path {
  rule_1989(std::string engine_name, recorded_parts parts);

  std::string engine;
  lockstep_on_path compared;
  /// For each increment of the answer [steps][increments]; of a step that was not followed, none.
  std::vector<std::vector<row_of_1989>> rows = {};
  std::set<int> only = {};  ///< the combinations that were followed, from 1; empty: all
  bool same_events = true;  ///< both paths have the same events, up to the end of the path that ended first
  std::vector<state_difference> differences = {};  ///< for each certified step that both paths solved
};

/// Two shares of a step are the same if they differ by at most this number.
inline constexpr double same_share = 1e-6;

/// Follows the path of the 1989 rule, and compares it with `answer`. `shown` observe the path.
/// `calls_are_kept`: calls are written to files, so the default engine is that of 1989, however slow.
[[nodiscard]] std::shared_ptr<const rule_1989> follow_rule_1989(const run_result& answer,
                                                                const run_request& wanted,
                                                                bool calls_are_kept, recorded_parts parts,
                                                                const std::vector<observer*>& shown);

}  // namespace contct
