// The structure's part of a picture in SVG.
#pragma once

#include <string>
#include <string_view>

#include "contct/write/pictures.hpp"

namespace contct::write {

// In pixels: the page's width, where the structure's picture begins, and the room left and right of it.
inline constexpr double page_width = 900.0;
inline constexpr double picture_top = 96.0;
inline constexpr double side = 60.0;

/// What is drawn of a structure: a frame of a problem, and which of its parts; and how.
struct structure_picture {
  const problem& what;
  const frame& at;
  const shown_parts& shown;
  std::string_view state = "Final state";
  svg::scale X{}, Y{};
  double magnified = 1.0, bottom = 0.0;

  [[nodiscard]] double w_of(int node) const { return deflection_of(what, at, node); }

  /// The marks of all pairs, of size `r`, at the places of their nodes.
  template <class Spot>
  [[nodiscard]] std::string marks(double r, Spot spot_of) const {
    std::string text;
    for (const int i : shown.pairs) text += mark_of_pair(what, at, i, spot_of(what.pairs[i].node), r);
    return text;
  }
};

/// A beam from the side, a plate from above, a structure from elsewhere in the view that shows most, or as a
/// table where its places are not known.
[[nodiscard]] svg::drawn draw_structure(const structure_picture& s);

}  // namespace contct::write
