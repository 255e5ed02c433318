// The listing's statements in rational numbers.
#pragma once

#include <span>
#include <vector>

#include "contct/exact/lifted_solver.hpp"
#include "contct/kernel/call.hpp"

namespace contct::exact {

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
  vector s;                   ///< SS [pairs]
  std::vector<way_to_s> way;  ///< how each pair came to its s [pairs]
  rational s_min = 1;         ///< SMIN
  std::vector<int> toggled;   ///< pairs from 0, in their order

  /// Pairs, from 0, that have their event exactly at SMIN.
  [[nodiscard]] std::vector<int> winners() const;
};

/// One call of CONTCT without rounding. EPSGAP, DELTA and EPSMUL are the decimals that are printed.
[[nodiscard]] listing_answer answer_exactly(std::span<const listing_pair> pairs);

}  // namespace contct::exact
