// What pictures and tables read off a path: its loads, and its states over all nodes and pairs, and in space
// where nodes have places.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "contct/path/frames.hpp"
#include "contct/structure/problem.hpp"

namespace contct::write {

/// The loads of a problem's steps, and what acts between them. Steps count from 1.
class load_path {
 public:
  /// `p` must outlive this object.
  explicit load_path(const problem& p);

  /// Everything that acts at share `fraction` of step `step`; nothing in step 0, before the first.
  [[nodiscard]] load at(int step, double fraction) const;
  /// Its resultant; `step` is at least 1.
  [[nodiscard]] resultant resultant_at(int step, double fraction) const;

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
  pair_look look;
};
/// At deflection `w`.
[[nodiscard]] pair_reading reading_of(const contact_pair& p, double w, bool closed);
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
  [[nodiscard]] std::size_t& of(pair_look look) {
    return look == pair_look::open ? open : look == pair_look::closed ? closed : at_face;
  }
};
[[nodiscard]] pair_counts count_pairs(const problem& p, const frame& f);

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

[[nodiscard]] inline double dot(const in_space& a, const in_space& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// Euclidean.
[[nodiscard]] double length_of(const in_space& v);

/// A direction of view: unit vectors in space that point right and up on the page.
struct structure_view {
  const char* name;
  const char* words;
  in_space right, up;

  [[nodiscard]] double x_of(const in_space& at) const { return dot(right, at); }
  [[nodiscard]] double y_of(const in_space& at) const { return dot(up, at); }
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

}  // namespace contct::write
