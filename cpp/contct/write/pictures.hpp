// A run as pictures: one in SVG, with the pieces that SVG is made of, a page in HTML, and grids for ParaView.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "contct/write/finished_run.hpp"

namespace contct::write {
namespace svg {

/// From the least to the largest of the values taken.
struct span_of {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void take(double x);
  /// Positive, 1 for a single value: scales divide by it.
  [[nodiscard]] double range() const { return most > least ? most - least : 1.0; }
};

/// A straight scale: numbers onto the page.
struct scale {
  double from, per_unit, at;
  [[nodiscard]] double operator()(double x) const { return at + (x - from) * per_unit; }
};

/// A point on the page, y downwards.
struct spot {
  double x, y;
};

/// A part of the picture, and where its lower edge is.
struct drawn {
  std::string text;
  double bottom = 0.0;
};

/// 1, 2 or 5 times a power of ten, not above x, which is positive.
[[nodiscard]] double round_down(double x);

/// Round numbers from one to the other, between `about` / 2 and 3 `about` of them.
[[nodiscard]] std::vector<double> ticks(double from, double to, int about);

/// An element on a line of its own; `attributes` and `content` are markup.
[[nodiscard]] std::string element(std::string_view name, std::string_view attributes,
                                  std::string_view content = {});
[[nodiscard]] std::string circle(double x, double y, double r, std::string_view attributes,
                                 std::string_view content = {});
[[nodiscard]] std::string rectangle(double x, double y, double width, double height,
                                    std::string_view attributes, std::string_view content = {});
/// Text that may hold markup, such as a raised exponent.
[[nodiscard]] std::string text_markup(double x, double y, std::string_view attributes,
                                      std::string_view markup);

/// A tooltip, as content of an element.
[[nodiscard]] std::string title(std::string_view words);

// `kind` is a class of the picture's style sheet.
[[nodiscard]] std::string text_at(double x, double y, std::string_view kind, std::string_view words);
/// `d` as a path's attribute of that name; no path where it is empty.
[[nodiscard]] std::string path(std::string_view d, std::string_view kind, std::string_view content = {});
[[nodiscard]] std::string line(double x1, double y1, double x2, double y2, std::string_view kind);
/// Ticks and numbers below a picture, without a line.
[[nodiscard]] std::string axis_below(const scale& X, double from, double to, double y);

}  // namespace svg

/// One self-contained SVG: the final state, and how load and deflection went. A beam is drawn from the side
/// with its deflection magnified, a plate from above, a structure from elsewhere in the view that shows most,
/// or as a table where no places are known; under it the sum of the loads over the deflection of the node
/// that deflects most.
[[nodiscard]] std::string run_svg(const finished_run& r);

/// The structure alone, as it is before any load. `file` is the problem's, as it was named.
[[nodiscard]] std::string problem_svg(const problem& p, const std::string& file);

/// Pair `pair` (from 0) of a frame at a point, of size `r`, told in its tooltip: open is a ring, closed a
/// square, at its face a diamond.
[[nodiscard]] std::string mark_of_pair(const problem& p, const frame& f, int pair, const svg::spot& at,
                                       double r);

/// One HTML page that needs nothing else. The parallel edition of the two kernels is in it, folded.
[[nodiscard]] std::string run_page(const finished_run& r);

/// Everything the page shows, of a large problem the parts that choose_parts finds; numbers with all their
/// digits.
[[nodiscard]] nlohmann::ordered_json page_data(const finished_run& r);

/// A frame as an unstructured grid, for everything that reads VTK's XML files: lines or quadrilaterals, and a
/// vertex for each pair, at the undeformed places; beams lie along x, plates in x and y, z is up. Points have
/// "displacement" (0, 0, w), each dof by its name, the "reaction" at each dof and, where there is a bed, its
/// "pressure"; cells have "pair" (0 for an element), "state" (0 open,
/// 1 closed, 2 at its face; -1 for an element), "surface", "direction" (1 to 3 along the axes, 4 to 6 about
/// them; 0), "face", "gap", "force", and what the element's ends or corners read, by name. The field data say
/// step, increment and share.
///
/// A structure from elsewhere is drawn where its nodes have places: its edges as lines, "displacement" and
/// "reaction" as they are, "rotation" where it has any; pairs at dofs without a place have no cell.
[[nodiscard]] std::string vtu_of_frame(const problem& p, const frame& f);

/// The same grid in `count` pieces, 1 or more: files of their own, and one that lists them. The elements are
/// shared evenly, a plate's by rows; each piece has the points of its elements, so that points between two
/// pieces are in both. A pair, and a point of no element, is in one. Where there are fewer rows than pieces,
/// some are empty.
struct grid_pieces {
  std::function<std::string(std::size_t number)> piece;  ///< from 0
  /// The file that lists them; `stem` is their common name without folder: see name_of_piece.
  std::function<std::string(const std::string& stem)> index;
};
[[nodiscard]] grid_pieces pieces_of_frame(const problem& p, const frame& f, std::size_t count);

/// "out_7.vtu" for 7, of a stem "out".
[[nodiscard]] std::string name_of_piece(const std::string& stem, std::size_t number);

/// A collection of `count` files, by their place in which they were kept; "time" counts them from 0.
/// `stem` is their common name without folder: see name_of_frame.
[[nodiscard]] std::string pvd_of_frames(const std::string& stem, std::size_t count);

/// "out.007.vtu" for 7, of a stem "out".
[[nodiscard]] std::string name_of_frame(const std::string& stem, std::size_t number);

}  // namespace contct::write
