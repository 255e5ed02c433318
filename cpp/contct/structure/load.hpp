// Loads on a structure, and their mixtures along a proportional step.
#pragma once

#include <vector>

namespace contct {

/// A force or moment at one dof of one node, work-conjugate to the dof.
struct point_load {
  int node;      ///< from 0
  int dof;       ///< within the node, from 0
  double value;  ///< positive as the dof
};

/// Force per length (beams), as a polynomial in x: a0 + a1 x + a2 x^2 + ...; positive up.
struct distributed_load {
  std::vector<double> polynomial;  ///< coefficients, constant first; at least one
  std::vector<int> elements;       ///< from 0; empty means all
};

/// Everything that acts on the structure at one moment.
struct load {
  std::vector<point_load> points;
  std::vector<distributed_load> distributed;
};

/// The load at share `fraction` of the way from `before` to `after`, with equal places merged.
/// Exactly `after` at 1.
[[nodiscard]] load mix(const load& before, const load& after, double fraction);

}  // namespace contct
