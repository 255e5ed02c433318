// All that tables, pictures and the page of a run are made from: its loads, what is read off its states, what
// is recorded while it goes on, how it ended, and which parts of it are shown.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/path/frames.hpp"
#include "contct/path/observer.hpp"
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

/// The one of these nodes that deflects most.
[[nodiscard]] extreme largest_deflection(const problem& p, const frame& f, std::span<const int> among);

/// Pairs of each look: open, closed, at their faces.
struct pair_counts {
  std::size_t open = 0, closed = 0, at_face = 0;
  [[nodiscard]] std::size_t& of(pair_state look) {
    return look == pair_state::open ? open : look == pair_state::closed ? closed : at_face;
  }
};
[[nodiscard]] pair_counts count_pairs(const problem& p, const frame& f);

/// What beds press on the structure by, at each node: force over tributary share [nodes].
[[nodiscard]] std::vector<double> bed_pressure(const problem& p, const frame& f);

/// A node's name in tables: its number, from 1, or its label where each dof is a node of its own.
[[nodiscard]] std::string place_name(const model& m, int node);

/// Where a node is: x along a beam; x and y on a plate.
struct place {
  double x = 0.0, y = 0.0;
};
[[nodiscard]] place place_of_node(const model& m, int node);

/// A point, or a displacement, of a structure from elsewhere.
using in_space = std::array<double, 3>;

/// The dof, from 0, of a node along each axis and about it; -1 where it has none.
struct dofs_of_node {
  std::array<int, 3> along{-1, -1, -1};
  std::array<int, 3> about{-1, -1, -1};

  [[nodiscard]] bool operator==(const dofs_of_node&) const = default;
};
/// Of each node.
[[nodiscard]] std::vector<dofs_of_node> dofs_of_nodes(const placed_nodes& places);

/// The axes, from 0, along which any node can move.
[[nodiscard]] std::vector<int> axes_of(const placed_nodes& places);

/// The displacements at three dofs in a frame; 0 where there is none.
[[nodiscard]] in_space reading_at(const std::array<int, 3>& dofs, const frame& f);

/// A direction of view: unit vectors in space that point right and up on the page.
struct structure_view {
  const char* name;
  const char* words;
  in_space right, up;
};

/// Straight on to each plane of the axes, then from the front, a little from the right and from above.
inline constexpr std::array<structure_view, 4> all_views = {{
    {"xy", "x to the right, y up", {1, 0, 0}, {0, 1, 0}},
    {"xz", "x to the right, z up", {1, 0, 0}, {0, 0, 1}},
    {"yz", "y to the right, z up", {0, 1, 0}, {0, 0, 1}},
    // The eye is at (3, -6, 3), nearly: right and up are at right angles, and of length 1.
    {"oblique", "oblique, z up", {0.8944, 0.4472, 0}, {-0.1826, 0.3651, 0.9129}},
}};

/// The number of the view that shows most: straight on where one coordinate is the same for all nodes and
/// none of them can leave that plane, else the last.
[[nodiscard]] int fitting_view(const placed_nodes& places);

/// One increment of the path, with events of its own: the path's are gone when it goes on.
struct increment_record : increment {
  explicit increment_record(const increment& i)
      : increment{i.step, i.number, i.s, i.fraction, {}, i.snaps}, events(i.events.begin(), i.events.end()) {}

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
  static constexpr std::size_t most_increments = 1200, most_calls = 1200;
  static constexpr std::size_t most_ss = 8, most_log = 200'000;  ///< pairs of a call; bytes

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

class envelope;

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
  std::string date = {};           ///< of the run, in UTC; may be empty
  const envelope* all_increments =
      nullptr;  ///< where it was asked for; otherwise that of the kept states is made
};

/// At most so many numbers in all frames together: places along a beam, points of a plate's grid, states of
/// pairs, displacements of a mesh.
inline constexpr std::size_t most_places = 24'000, most_grid_points = 90'000, most_pair_states = 36'000,
                             most_mesh_numbers = 900'000;
/// At most so many in any one frame; events in any one increment.
inline constexpr std::size_t most_pairs = 1000, most_pairs_of_a_beam = 300, most_supports = 300,
                             most_edges = 20'000, most_loads = 60, most_events = 60;
/// Pieces of a beam's distributed load that are drawn.
inline constexpr std::size_t most_load_pieces = 200;

/// A place along a beam: a share of the element that begins at a node, the node itself where that is 0.
struct station {
  int node;
  double share;
};

/// Deflection, slope, moment and shear of a beam at stations: exact, as extremes.hpp has them.
class station_reader {
 public:
  /// All arguments must outlive this object.
  station_reader(const beam& b, const load& l, std::span<const double> u,
                 std::span<const double> element_values = {})
      : beam_(b), u_(u), lines_(b, l, u, element_values) {}

  [[nodiscard]] double x(const station& s) const;
  [[nodiscard]] double w(const station& s) const;
  [[nodiscard]] double slope(const station& s) const;
  [[nodiscard]] const beam_lines& lines() const { return lines_; }

 private:
  const beam& beam_;
  std::span<const double> u_;
  beam_lines lines_;
};

/// Neighbouring elements of a beam, from `first` to before `last`, along which every step's distributed load
/// is one polynomial.
struct load_piece {
  int first, last;
};
/// Those that carry any, in order.
[[nodiscard]] std::vector<load_piece> load_pieces(const problem& p, const beam& b);

/// Which parts of a large run its page shows, so that they stay quick to read and to draw: nodes,
/// grid lines and pairs, all counted from 0, rising.
struct shown_parts {
  std::vector<int> nodes;          ///< of a beam, or of a structure from elsewhere whose places are known
  std::vector<station> stations;   ///< of a beam: these nodes, and places in loaded elements
  std::vector<load_piece> loaded;  ///< of a beam
  std::vector<int> edges;          ///< of the latter
  double reach = 0.0;              ///< of the latter: the largest displacement of these nodes on the path
  std::vector<int> columns;        ///< grid lines of a plate
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

/// A title for people: the problem's, or its file's name.
[[nodiscard]] std::string title_of(const problem& p, const std::string& file);
[[nodiscard]] inline std::string title_of(const finished_run& r) {
  return title_of(r.what, r.file);
}

}  // namespace contct::write
