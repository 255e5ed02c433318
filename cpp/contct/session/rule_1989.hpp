// The path of the 1989 rule beside an answer of the corrected rule: FORTRAN and C++ in lockstep, what they
// did otherwise, and which of their states are wrong.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contct/session/run.hpp"

namespace contct {

/// The kernels of the 1989 rule in a run of both rules; the first leads.
inline const std::vector<std::string> kernels_of_1989 = {"fortran", "cpp"};

/// An event that only one of the two paths has at its share of the step's load.
struct other_event {
  event what = {};
  std::optional<double> at;  ///< the share at which the 1989 rule has it; nothing: it does not in this step
};

/// What the 1989 rule did in an increment of the answer.
struct row_of_1989 {
  std::vector<other_event> otherwise = {};
  bool reached = true;  ///< false: its path had ended before
};

/// The number at the end of a step in which the 1989 rule differs most from the answer, relative to its kind.
struct state_difference {
  int step;                         ///< from 1
  quantity what = quantity::w;      ///< its kind
  std::string at = {};              ///< its place: "pair 3", "node 5", "the support at node 1", "element 2"
  double value = 0.0, right = 0.0;  ///< by the 1989 rule, and in the answer
  double share = 0.0;               ///< their difference, of the size of the kind

  [[nodiscard]] bool is_wrong() const { return !(share <= certified_share); }
};

struct rule_1989 {
  rule_1989(std::string engine_name, recorded_parts parts);

  std::string engine;
  lockstep_on_path compared;
  run_recorder record;
  path_end end = {};
  std::vector<std::vector<row_of_1989>> rows = {};  ///< of the answer [steps][increments]
  bool same_events = true;                          ///< each event of either path has its partner
  std::vector<state_difference> differences = {};   ///< of each step that both ended, the answer certified
};

/// Shares of a step's load that differ by no more are the same.
inline constexpr double same_share = 1e-6;

/// Follow the path of the 1989 rule when that of `answer` is over, and compare the two. `shown` observe it.
/// `calls_are_kept`: it is solved as in 1989, however long that takes.
[[nodiscard]] std::shared_ptr<const rule_1989> follow_rule_1989(const run_result& answer,
                                                                const run_request& wanted,
                                                                bool calls_are_kept, recorded_parts parts,
                                                                const std::vector<observer*>& shown);

}  // namespace contct
