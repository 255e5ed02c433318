// The result of a run, from which all outputs are made: what is recorded while it goes on, and how it ended.
#pragma once

#include <fmt/format.h>

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
  int step = 0;                             ///< from 1; 0: nothing is loaded yet
  int number = 0;                           ///< of the increment in the step, from 1; 0: it ended without one
  double fraction = 0.0;                    ///< share of the step's load consumed
  std::vector<double> displacement = {};    ///< [dofs]
  std::vector<int> isep = {};               ///< [pairs]
  std::vector<double> pair_forces = {};     ///< more accurate than by `displacement`; may be empty [pairs]
  std::optional<end_numbers> numbers = {};  ///< likewise

  [[nodiscard]] bool closed(std::size_t pair) const { return isep[pair] == in_contact; }
};

/// One increment of the path, and the last call before it.
struct increment_record {
  int step, number;
  double s, fraction;
  bool snaps;
  std::vector<event> events;
  std::optional<double> smin = {};  ///< as the kernel gave it; none before the first call
  bool equal = true;                ///< the kernels agreed in that call
  // If states are asked for, as `increment` has them [pairs]:
  std::vector<double> d = {}, pair_force = {};
  std::vector<int> isep = {};
};

/// One call of the leader, and how the followers answered it.
struct call_record {
  int step = 0, number = 0;  ///< of the increment it led to; 0 and 0 when it led to none
  double smin = 0.0;
  std::vector<double> ss;                  ///< of the first pairs
  std::vector<follower_answer> followers;  ///< none when nothing was compared
};

/// A step as far as the path went.
struct step_record {
  structure_state end;
  double rcond;
  bool from_fallback, from_exact_path;  ///< as step_state has them
  std::vector<increment_record> increments;
};

/// What is recorded of a path beside its increments and the ends of its steps.
struct recorded_parts {
  bool calls = false;   ///< the first ones, and the beginning of the unit-26 text; what is beyond is counted
  bool states = false;  ///< D, ISEP and the forces at the pairs after each increment
};

/// Observes a path and records it.
class run_recorder final : public observer {
 public:
  static constexpr std::size_t most_calls = 1200, most_ss = 8, most_log = 200'000;  ///< calls, pairs, bytes

  /// `compared` is null for a kernel alone; it must outlive this object, and observe before it.
  explicit run_recorder(const lockstep* compared = nullptr, recorded_parts parts = {})
      : compared_(compared), parts_(parts) {}

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  [[nodiscard]] bool keeps_states() const { return parts_.states; }

  std::vector<step_record> steps;
  std::vector<call_record> calls;
  std::string log;
  std::size_t all_calls = 0, all_log = 0;  ///< kept or not

 private:
  void keep_call(const answered_call& c);

  const lockstep* compared_;
  recorded_parts parts_;
  bool answers_ = false;                      // the last call kept has not led to an increment yet
  std::optional<double> smin_;                // of the last call
  std::vector<increment_record> increments_;  // of the current step
};

struct rule_1989;  // contct/session/rule_1989.hpp

/// How another kernel's own path compares with the leader's.
struct compared_path {
  std::string kernel;
  free_run_difference difference;
  bool certified;
  std::string distances;  ///< in words
};

/// How much the numbers of a kind change on a mesh of half the element size: see changes_between.
struct mesh_change {
  std::string_view kind;
  double change = 0.0;
  double of = 0.0;  ///< the largest of its kind on the finer mesh
};

/// All that is known of a run when it is over: every output is made from this.
struct run_result {
  /// `p` and `s`, its structure, must outlive this object.
  run_result(const problem& p, const linear_structure& s, std::unique_ptr<exact_means> exactly = {})
      : what(p), structure(s), judged(p, s, std::move(exactly)) {}

  const problem& what;
  const linear_structure& structure;
  certifier judged;
  run_recorder record;
  early_toggles early;
  path_end end;
  std::string file;                  ///< the problem's, as it was named
  std::vector<std::string> kernels;  ///< the leader first; in a run of both rules those of 1989 behind it
  std::string engine;
  std::optional<lockstep_on_path> compared;  ///< none: no kernel was compared call by call
  std::shared_ptr<const rule_1989> beside;   ///< of a run of both rules; null: of others, and without answer
  std::vector<compared_path> free_runs;
  bool equal = true;                 ///< the kernels agreed
  std::vector<mesh_change> refined;  ///< empty: not asked for, or not solved on both meshes
  std::string comparison;            ///< how they did, in words; empty for a kernel alone
  std::vector<std::string> facts;    ///< version, listing, floating point
  std::string date;                  ///< of the run, in UTC; may be empty
  bool envelope = false;             ///< it was asked for

  /// As results have it: "solved", "kernels-disagree", ..
  [[nodiscard]] std::string_view status() const;
  /// What compared kernels call by call, on the path or beside it; null: nothing did.
  [[nodiscard]] const lockstep_on_path* compared_calls() const;
  /// What recorded the path whose calls the run has.
  [[nodiscard]] const run_recorder& record_of_calls() const;
};

/// "8 calls, 64 values compared, 0 mismatches", of what compares the calls of a path.
template <class Comparing>
[[nodiscard]] std::string counts_of(const Comparing& c) {
  return fmt::format("{}, {} compared, {}", counted(c.calls(), "call"), counted(c.compared().values, "value"),
                     counted(c.compared().mismatches, "mismatch"));
}

/// A title for people: the problem's, or its file's name.
[[nodiscard]] std::string title_of(const problem& p, const std::string& file);

/// Every element of a beam in two, of a plate in four; loads, supports and [[contact]] stay where they are. A
/// new node is on a bed where all of its neighbours are, or may be because they are fixed in w. On a plate a
/// dof that is fixed at all of its neighbours is fixed there too, and settles by their mean.
[[nodiscard]] problem refined(const problem& p);

/// How much the extremes ("w", "moment", "shear", "mx", ..), the contact forces of [[contact]] ("force"), the
/// "pressure" of beds and a beam's reactions ("reaction") differ at most in any step.
[[nodiscard]] std::vector<mesh_change> changes_between(const run_result& coarse, const run_result& fine);

}  // namespace contct
