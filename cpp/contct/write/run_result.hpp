// The result of a run, from which all outputs are made: its loads, what is read off its states, what is
// recorded while it goes on, and how it ended.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/path/frames.hpp"
#include "contct/path/free_run.hpp"
#include "contct/path/path.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/structure/extremes.hpp"
#include "contct/structure/problem.hpp"

namespace contct::write {

/// The loads of a problem's steps, and what acts between them. Steps count from 1.
class load_path {
 public:
  /// `p` must outlive this object.
  explicit load_path(const problem& p);

  /// Everything that acts at share `fraction` of step `step`; nothing in step 0, before the first.
  [[nodiscard]] load at(int step, double fraction) const;
  /// Its resultant, 0 where the sum is nothing but rounding; `step` is at least 1.
  [[nodiscard]] resultant resultant_at(int step, double fraction) const;
  /// The resultant's force, in step 0 too.
  [[nodiscard]] double force_at(int step, double fraction) const {
    return step == 0 ? 0.0 : resultant_at(step, fraction).force;
  }

  /// Has either end of the step more than 32 parts to list? Each element of a scattered list counts.
  [[nodiscard]] bool has_many_parts(int step) const;

  /// A few words: "w -15 at node 3", "uniform -768", or the resultant force of a mixed load; with
  /// as many digits, six at most, as fit into `width` columns. Never cut: the number alone, or
  /// nothing, where the words do not fit.
  [[nodiscard]] std::string words_at(int step, double fraction, int width) const;

 private:
  const problem& problem_;
  std::vector<resultant> totals_;   // at the start, then at the end of each step
  std::vector<std::size_t> parts_;  // how many things there are to write, likewise
};

/// Do these elements follow one another, each once?
[[nodiscard]] bool is_run(const std::vector<int>& elements);

/// The deflection of node `node`, from 0, under the displacement `u` [dofs].
[[nodiscard]] double deflection_of(const problem& p, std::span<const double> u, int node);
[[nodiscard]] inline double deflection_of(const problem& p, const frame& f, int node) {
  return deflection_of(p, f.displacement, node);
}

/// How a pair stands, and its gap and force as results have them.
struct pair_reading {
  double w, gap, force;
  pair_state look;
};
/// At deflection `w`.
[[nodiscard]] pair_reading reading_of(const contact_pair& p, double w, bool closed);
/// Reactions and what is read off the elements, in a frame under load `l`.
[[nodiscard]] std::vector<double> reactions_in(const problem& p, const load& l, const frame& f);
[[nodiscard]] element_results elements_in(const problem& p, const load& l, const frame& f);

/// Pair `pair`, from 0, in a frame.
[[nodiscard]] pair_reading reading_of(const problem& p, const frame& f, std::size_t pair);

/// A place, from 0, and the value there.
struct extreme {
  int at = 0;
  double value = 0.0;

  /// Keep the larger one of this and another value, by magnitude.
  void take(int other_at, double other);
};

/// The nodes whose displacement is a deflection: all of a beam and a plate. Of a matrix the dofs that are
/// known to be lengths: those that meet faces, and those along an axis where places are known; all where
/// there are neither.
[[nodiscard]] std::vector<int> deflecting_nodes(const problem& p);

/// Pairs of each look: open, closed, at their faces.
struct pair_counts {
  std::size_t open = 0, closed = 0, at_face = 0;
  [[nodiscard]] std::size_t& of(pair_state look) {
    return look == pair_state::open ? open : look == pair_state::closed ? closed : at_face;
  }
};

/// What beds press on the structure by, at each node: force over tributary share [nodes].
[[nodiscard]] std::vector<double> bed_pressure(const problem& p, const frame& f);

/// A node's name in tables: its number, from 1, or its label where each dof is a node of its own.
[[nodiscard]] std::string place_name(const model& m, int node);

/// Where a node is: x along a beam; x and y on a plate.
struct place {
  double x = 0.0, y = 0.0;
};
[[nodiscard]] place place_of_node(const model& m, int node);

/// One increment of the path, with events of its own: the path's are gone when it goes on.
struct increment_record : increment {
  explicit increment_record(const increment& i)
      : increment{i.step, i.number, i.s, i.fraction, {}, i.snaps, {}},
        events(i.events.begin(), i.events.end()) {}

  std::vector<event> events;
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
  frame end;
  double rcond;
  std::vector<increment_record> increments;
};

/// Observes a path and keeps its increments and the ends of its steps; and where calls are asked for, the
/// first ones and the beginning of the unit-26 text. What is beyond is counted.
class run_recorder final : public observer {
 public:
  static constexpr std::size_t most_calls = 1200, most_ss = 8, most_log = 200'000;  ///< calls, pairs, bytes

  /// `compared` is null for a kernel alone; it must outlive this object, and observe before it.
  explicit run_recorder(const lockstep* compared = nullptr, bool keeps_calls = false)
      : compared_(compared), keeps_calls_(keeps_calls) {}

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  std::vector<step_record> steps;
  std::vector<call_record> calls;
  std::string log;
  std::size_t all_calls = 0, all_log = 0;  ///< kept or not

 private:
  const lockstep* compared_;
  bool keeps_calls_;
  bool answers_ = false;                      // the last call kept has not led to an increment yet
  std::vector<increment_record> increments_;  // of the current step
};

/// How another kernel's own path compares with the leader's.
struct compared_path {
  std::string kernel;
  free_run_difference difference;
  bool certified;
};

class envelope;

/// All that is known of a run when it is over: every output is made from this.
struct run_result {
  const problem& what;
  const run_recorder& record;
  const certifier& judged;
  const early_toggles& early;
  path_end end;
  std::string file = {};                  ///< the problem's, as it was named
  std::vector<std::string> kernels = {};  ///< the leader first
  std::string engine = {};
  const lockstep* compared = nullptr;  ///< null: no kernel was compared call by call
  std::vector<compared_path> free_runs = {};
  bool equal = true;                         ///< the kernels agreed
  std::string comparison = {};               ///< how they did, in words; empty for a kernel alone
  std::vector<std::string> facts = {};       ///< version, listing, floating point
  std::string date = {};                     ///< of the run, in UTC; may be empty
  const envelope* all_increments = nullptr;  ///< where it was asked for
  std::span<const frame> frames = {};        ///< the states that are kept for pictures; may be empty

  /// As results have it: "solved", "kernels-disagree", ..
  [[nodiscard]] std::string_view status() const;
};

/// A title for people: the problem's, or its file's name.
[[nodiscard]] std::string title_of(const problem& p, const std::string& file);
}  // namespace contct::write
