// Follows the path of the 1989 rule, FORTRAN and C++ in lockstep, and compares it with an answer of the
// corrected rule: which events differ, and which states are wrong.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contct/session/run.hpp"

namespace contct {

/// The kernels of the 1989 rule in a run of both rules; the first one leads.
inline const std::vector<std::string> kernels_of_1989 = {"fortran", "cpp"};

/// An event that the two paths do not have at the same share of the step.
struct other_event {
  event what = {};
  std::optional<double> at;  ///< share in the 1989 path; empty: not in this step
};

/// The differences of the 1989 path in an increment of the answer.
struct row_of_1989 {
  std::vector<other_event> otherwise = {};
  bool reached = true;  ///< false: the path of the 1989 rule had ended before
};

/// The number at the end of a step in which the 1989 rule differs most, relative to the size of its kind.
struct state_difference {
  int step;                         ///< from 1
  quantity what = quantity::w;      ///< kind of the number
  std::string at = {};              ///< place: "pair 3", "node 5", "the support at node 1", "element 2"
  double value = 0.0, right = 0.0;  ///< the number by the 1989 rule, and in the answer
  double share = 0.0;               ///< their difference as a share of the size of the kind

  [[nodiscard]] bool is_wrong() const { return !(share <= certified_share); }
};

struct rule_1989 {
  rule_1989(std::string engine_name, recorded_parts parts);

  std::string engine;
  lockstep_on_path compared;
  run_recorder record;
  path_end end = {};
  std::vector<std::vector<row_of_1989>> rows = {};  ///< one for each increment [steps][increments]
  bool same_events = true;                          ///< both paths have the same events
  std::vector<state_difference> differences = {};   ///< only certified steps that both paths solved
};

/// Two shares of a step are the same if they differ by at most this number.
inline constexpr double same_share = 1e-6;

/// Follows the path of the 1989 rule after that of `answer`, and compares the two. `shown` observe the path.
/// `calls_are_kept`: the default engine is that of 1989, however long it takes.
[[nodiscard]] std::shared_ptr<const rule_1989> follow_rule_1989(const run_result& answer,
                                                                const run_request& wanted,
                                                                bool calls_are_kept, recorded_parts parts,
                                                                const std::vector<observer*>& shown);

}  // namespace contct
