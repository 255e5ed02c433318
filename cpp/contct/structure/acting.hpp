// What acts on the elements of a beam or plate, in one normal form: a polynomial over an interval or a
// rectangle, or a value at a place, in rational numbers.
#pragma once

#include <array>
#include <vector>

#include "contct/number/rational.hpp"
#include "contct/structure/line.hpp"

namespace contct {

/// The coefficients of a load: the sum of its parts in the file, each times its factors.
[[nodiscard]] rational_vector coefficients_of(const distributed_load& d);
[[nodiscard]] rational_vector coefficients_of(const placed_load& p);

/// The part of a line that a load acts on: from the share `from` of interval `first` to the share `to` of
/// interval `last`. For a load at one place, the two intervals and shares are equal.
struct loaded_part {
  int first = 0, last = 0;
  rational from = 0;
  rational to = 1;

  [[nodiscard]] std::array<rational, 2> in(int i) const {
    return {i == first ? from : rational(0), i == last ? to : rational(1)};
  }
  [[nodiscard]] bool covers(int i) const { return (i != first || from == 0) && (i != last || to == 1); }
  /// The coordinates of the ends.
  [[nodiscard]] std::array<rational, 2> ends(const line<rational>& points) const {
    return {rational(points.at(first) + from * points.length(first)),
            rational(points.at(last) + to * points.length(last))};
  }
};

struct acting {
  load_kind what = load_kind::force;
  loaded_part x;
  loaded_part y;  ///< interval 0 for a beam
  /// Of a force along a beam: coefficients in x; of a moment on a plate: its totals, which do work on wx and
  /// wy; otherwise one number.
  rational_vector values;
};

/// The distributed and placed loads of `l`, a part for each run of consecutive elements in a row. `x`, `y`:
/// the grid lines of a plate; for a beam its nodes, and null.
[[nodiscard]] std::vector<acting> acting_on(const line<rational>& x, const line<rational>* y, const load& l);

}  // namespace contct
