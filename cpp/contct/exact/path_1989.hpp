// The 1989 rule in exact arithmetic: one call of CONTCT.
#pragma once

#include <span>
#include <vector>

#include "contct/exact/lifted_solver.hpp"

namespace contct {

/// What CONTCT is told of a pair.
struct listing_pair {
  rational c;       ///< position of its face
  rational d;       ///< D there
  rational d_star;  ///< d* there
  bool closed;      ///< in contact
  int surface;      ///< face_above or face_below
};

/// What CONTCT answers.
struct listing_answer {
  rational_vector s;         ///< SS [pairs]
  rational s_min = 1;        ///< SMIN
  std::vector<int> toggled;  ///< pairs from 0, in their order
};

/// One call of CONTCT without rounding. EPSGAP, DELTA and EPSMUL are the decimals that are printed.
[[nodiscard]] listing_answer answer_exactly(std::span<const listing_pair> pairs);

}  // namespace contct
