// Loads on a structure, and their mixtures along a proportional step.
#pragma once

#include <numeric>
#include <span>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::structure {

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

/// Add the point loads of `l` to `f` [dofs].
void add_point_loads(const load& l, int dofs_per_node, std::span<double> f);

/// The value of a polynomial at x; `coefficients` from the constant on.
[[nodiscard]] double polynomial_at(std::span<const double> coefficients, double x);

/// Call visit(element, polynomial) for every element, from 0, that a distributed load acts on.
template <class Visit>
void for_each_loaded_element(const load& l, int elements, Visit visit) {
  std::vector<int> all(elements);
  std::iota(all.begin(), all.end(), 0);
  for (const distributed_load& d : l.distributed)
    for (const int e : d.elements.empty() ? all : d.elements) visit(e, d.polynomial);
}

/// The length that each point of a line stands for: half of each interval beside it. `x` increases.
[[nodiscard]] std::vector<double> tributary_lengths(std::span<const double> x);

}  // namespace contct::structure
