// All that pictures and the page of a run are made from: what is recorded while it goes on, how it ended, and
// which parts of it are shown.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/early_toggles.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/path/frames.hpp"
#include "contct/path/observer.hpp"
#include "contct/structure/problem.hpp"

namespace contct::write {

/// One increment of the path.
struct increment_record {
  explicit increment_record(const increment& i)
      : step(i.step),
        number(i.number),
        s(i.s),
        fraction(i.fraction),
        snaps(i.snaps),
        events(i.events.begin(), i.events.end()) {}

  int step, number;
  double s, fraction;
  bool snaps;
  std::vector<event> events;
};

/// One call of the leader, and how the followers answered it.
struct call_record {
  int step = 0, number = 0;  ///< of the increment it led to; 0 and 0 when it led to none
  double smin = 0.0;
  std::vector<double> ss;                  ///< of the first pairs
  std::vector<follower_answer> followers;  ///< none when nothing was compared
};

/// Observes a path and keeps what a page can show: the first increments and calls, and the beginning
/// of the unit-26 text. What is beyond is counted.
class run_record final : public observer {
 public:
  static constexpr std::size_t most_increments = 1200;
  static constexpr std::size_t most_calls = 1200;
  static constexpr std::size_t most_ss = 8;
  static constexpr std::size_t most_log = 200'000;  ///< bytes

  /// `compared` is null for a kernel alone; it must outlive this object, and observe before it.
  explicit run_record(const lockstep* compared) : compared_(compared) {}

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;

  std::vector<increment_record> increments;
  std::vector<call_record> calls;
  std::string log;
  std::size_t all_increments = 0, all_calls = 0, all_log = 0;  ///< kept or not

 private:
  const lockstep* compared_;
  bool answers_ = false;  // the last call kept has not led to an increment yet
};

struct finished_run {
  const problem& what;
  const frame_keeper& kept;
  const run_record& record;
  const certifier& judged;
  const early_toggles& early;
  std::string file;                  ///< the problem's, as it was named
  std::vector<std::string> kernels;  ///< the leader first
  std::string engine;
  std::string status;              ///< as results have it: "solved", ...
  std::string end;                 ///< why the path did not reach its end, in words; empty when it did
  bool in_lockstep = false;        ///< every call was put to the other kernels
  bool equal = true;               ///< and they agreed (in lockstep or on paths of their own)
  std::string comparison;          ///< how they did, in words; empty for a kernel alone
  std::vector<std::string> facts;  ///< version, listing, floating point
};

/// At most so many numbers in all frames together: places along a beam, points of a plate's grid, states of
/// pairs, displacements of a mesh.
inline constexpr std::size_t most_places = 24'000, most_grid_points = 90'000, most_pair_states = 36'000,
                             most_mesh_numbers = 900'000;
/// At most so many in any one frame; events in any one increment.
inline constexpr std::size_t most_pairs = 1000, most_pairs_of_a_beam = 300, most_supports = 300,
                             most_edges = 20'000, most_loads = 60, most_events = 60;
/// Places along a beam at which its distributed load is given.
inline constexpr int load_samples = 25;

/// Which parts of a large run its page and picture show, so that they stay quick to read and to draw: nodes,
/// grid lines and pairs, all counted from 0, rising.
struct shown_parts {
  std::vector<int> nodes;    ///< of a beam, or of a structure from elsewhere whose places are known
  std::vector<int> edges;    ///< of the latter
  double reach = 0.0;        ///< of the latter: the largest displacement of these nodes on the path
  std::vector<int> columns;  ///< grid lines of a plate
  std::vector<int> rows;
  std::vector<int> pairs;
  std::vector<int> supports;    ///< the nodes whose supports are drawn
  std::vector<int> deflecting;  ///< all nodes that deflect: see deflecting_nodes
  int watched = 0;              ///< the one of these that deflects most on the path; always shown

  std::vector<std::string> omissions;  ///< what is left out and how the rest was chosen; empty: nothing is

  [[nodiscard]] bool has_support_at(int node) const;
};

[[nodiscard]] shown_parts choose_parts(const finished_run& r);

/// `count` of the numbers from 0 to `all` - 1, evenly, the first and last among them; all where they are
/// no more than that.
[[nodiscard]] std::vector<int> evenly(std::size_t all, std::size_t count);

/// The largest of these loads, at most `most_loads`, by falling magnitude.
[[nodiscard]] std::vector<point_load> largest_loads(std::vector<point_load> loads);

/// The force per length of `l` at `load_samples` even places from end to end.
[[nodiscard]] std::vector<double> sampled_load(const beam& b, const load& l);

/// A title for people: the problem's, or its file's name.
[[nodiscard]] std::string title_of(const finished_run& r);

/// `text` with its line ends replaced by blanks.
[[nodiscard]] std::string on_one_line(std::string text);

}  // namespace contct::write
