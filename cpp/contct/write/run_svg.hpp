// A run in one picture: the final state, and how load and deflection went.
#pragma once

#include <string>

#include "contct/write/finished_run.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/page_sampling.hpp"
#include "contct/write/svg_parts.hpp"

namespace contct::write {

/// One self-contained SVG. A beam is drawn from the side with its deflection magnified, a plate from above;
/// under it the sum of the loads over the deflection of the node that deflects most.
[[nodiscard]] std::string run_svg(const finished_run& r);

}  // namespace contct::write

namespace contct::write::svg {

inline constexpr double page_width = 900.0;
inline constexpr double picture_top = 96.0;
inline constexpr double side = 60.0;  // left and right of pictures

/// What is drawn: a frame of a problem, and which of its parts. All must outlive it.
struct shown_state {
  const problem& what;
  const frame& at;
  const shown_parts& shown;

  [[nodiscard]] double w_of(int node) const { return deflection_of(what, at, node); }
};

/// A beam from the side; deflections and faces magnified alike, as the heading says.
[[nodiscard]] drawn draw_beam(const beam& b, const shown_state& s);

/// A plate from above: a colour for each rectangle between the lines that are drawn.
[[nodiscard]] drawn draw_plate(const plate& p, const shown_state& s);

/// A structure from elsewhere in the view that shows most: its edges as they were, faint, and displaced, with
/// pairs and supports at their nodes.
[[nodiscard]] drawn draw_mesh(const placed_nodes& places, const shown_state& s);

/// A structure whose places are not known: its pairs as a table, the dof that moves most first.
[[nodiscard]] drawn draw_table(const shown_state& s);

/// Pair `pair` (from 0) at a point, of size `r`, told in its tooltip: open is a ring, closed a square, at its
/// face a diamond.
[[nodiscard]] std::string mark_of_pair(const shown_state& s, int pair, const spot& at, double r);

}  // namespace contct::write::svg
