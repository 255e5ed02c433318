// The result of a run, from which all outputs are made: what was recorded, and how the run ended.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/model/problem.hpp"
#include "contct/model/structure.hpp"
#include "contct/path/free_run.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/text/strings.hpp"

namespace contct {

/// The whole structure after an increment of a path, or at the end of a step.
struct structure_state {
  int step = 0;                             ///< from 1; 0: before the first step
  int number = 0;                           ///< increment in the step, from 1; 0: the step ended without one
  double fraction = 0.0;                    ///< share of the step's load applied
  std::vector<double> displacement = {};    ///< [dofs]
  std::vector<int> isep = {};               ///< [pairs]
  std::vector<double> pair_forces = {};     ///< empty: computed from `displacement` [pairs]
  std::optional<end_numbers> numbers = {};  ///< empty: computed from `displacement`

  [[nodiscard]] bool closed(std::size_t pair) const { return isep[pair] == in_contact; }
  [[nodiscard]] std::ptrdiff_t pairs_in_contact() const { return std::ranges::count(isep, in_contact); }
};

/// One increment of the path, with facts about the last call before the increment.
struct increment_record {
  int step, number;
  double s, fraction;
  bool snaps;
  std::vector<event> events;
  std::optional<double> smin = {};  ///< SMIN of the last call; empty before the first call
  bool equal = true;                ///< false: the kernels differed in the last call
  // Empty unless states are recorded [pairs]; see the same members of `increment`:
  std::vector<double> d = {}, pair_force = {};
  std::vector<int> isep = {};
};

/// One call of the leader, and the answers of the followers.
struct call_record {
  int step = 0, number = 0;  ///< step and increment after the call; 0 and 0: no increment followed
  double smin = 0.0;
  std::vector<double> ss;                  ///< only of the first most_ss pairs
  std::vector<follower_answer> followers;  ///< empty if no kernels are compared
};

/// A step, up to the point that the path reached.
struct step_record {
  structure_state end;
  double rcond;
  bool from_fallback, from_exact_path;  ///< see step_state
  std::vector<increment_record> increments;
};

/// The parts of a path that are recorded in addition to increments and ends of steps.
struct recorded_parts {
  bool calls = false;   ///< the first calls and the first bytes of unit 26; the others are only counted
  bool states = false;  ///< D, ISEP and pair forces after each increment
};

class run_recorder final : public observer {
 public:
  /// The most calls, pairs of a call, and bytes of unit 26 that are kept.
  static constexpr std::size_t most_calls = 1200, most_ss = 8, most_log = 200'000;

  /// `compared`, null for a single kernel, must outlive this object and observe each call before this object.
  explicit run_recorder(const lockstep* compared = nullptr, recorded_parts parts = {})
      : compared_(compared), parts_(parts) {}

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  [[nodiscard]] bool keeps_states() const { return parts_.states; }

  std::vector<step_record> steps;
  std::vector<call_record> calls;
  std::string log;
  std::size_t all_calls = 0, all_log = 0;  ///< all calls, and all bytes of unit 26, also those not kept

 private:
  void keep_call(const answered_call& c);

  const lockstep* compared_;
  recorded_parts parts_;
  bool answers_ = false;                      // the last call is kept, and no increment followed yet
  std::optional<double> smin_;                // SMIN of the last call
  std::vector<increment_record> increments_;  // increments of the current step
};

struct rule_1989;  // contct/session/rule_1989.hpp

/// The comparison of the path of another kernel with that of the leader.
struct compared_path {
  std::string kernel;
  free_run_difference difference;
  bool certified;
  std::string distances;  ///< the differences in words
};

/// The largest change of one kind of number if the element size is halved: see changes_between.
struct mesh_change {
  std::string_view kind;
  double change = 0.0;
  double of = 0.0;  ///< the largest number of this kind on the finer mesh
};

struct run_result {
  /// `p` and its structure `s` must outlive this object.
  run_result(const problem& p, const linear_structure& s, std::unique_ptr<exact_means> exactly = {})
      : what(p), structure(s), judged(p, s, std::move(exactly)) {}

  const problem& what;
  const linear_structure& structure;
  certifier judged;
  run_recorder record;
  early_toggles early;
  path_end end;
  std::string file;                  ///< the path of the problem file as given
  std::vector<std::string> kernels;  ///< the leader first; for both rules, the 1989 kernels last
  std::string engine;
  std::optional<lockstep_on_path> compared;  ///< empty: no kernel was compared call by call
  std::shared_ptr<const rule_1989> beside;   ///< null: not a run of both rules, or the answer is not_factored
  std::vector<compared_path> free_runs;
  bool equal = true;
  std::vector<mesh_change> refined;  ///< empty: not requested, or not solved on both meshes
  std::string comparison;            ///< how far the kernels agree, in words; empty for a single kernel
  std::vector<std::string> facts;    ///< version, listing, floating point
  std::string date;                  ///< date of the run in UTC; may be empty
  bool envelope = false;             ///< an envelope is requested

  /// The status as written in results: "solved", "kernels-disagree", ..
  [[nodiscard]] std::string_view status() const;
  /// The call-by-call comparison of kernels; in a run of both rules, on the 1989 path. Null if there is no
  /// comparison.
  [[nodiscard]] const lockstep_on_path* compared_calls() const;
  /// The record of the path whose calls are kept: the leader's path; in a run of both rules, the 1989 path.
  [[nodiscard]] const run_recorder& record_of_calls() const;
};

/// Formats the counts of a comparison: "8 calls, 64 values compared, 0 mismatches".
template <class Comparing>
[[nodiscard]] std::string counts_of(const Comparing& c) {
  return fmt::format("{}, {} compared, {}", counted(c.calls(), "call"), counted(c.compared().values, "value"),
                     counted(c.compared().mismatches, "mismatch"));
}

/// The problem's title, or the name of its file.
[[nodiscard]] std::string title_of(const problem& p, const std::string& file);

/// Returns the problem with every element of a beam divided in two, or of a plate in four. Loads, supports
/// and [[contact]] keep their places. A new node is on a bed if each of its neighbours is on the bed or fixed
/// in w, and at least one neighbour is on the bed. On a plate, a dof of a new node is fixed if it is fixed at
/// all neighbours, and settles by their mean. Throws std::invalid_argument for a matrix.
[[nodiscard]] problem refined(const problem& p);

/// Returns the largest difference, in any step, of each kind of number of two solved meshes: the extremes
/// ("w", "moment", "shear", "mx", ..), the contact forces of [[contact]] ("force"), the "pressure" of beds
/// and the reactions of a beam ("reaction").
[[nodiscard]] std::vector<mesh_change> changes_between(const run_result& coarse, const run_result& fine);

}  // namespace contct
