// Loads that need not follow the mesh (placed_load), in exact arithmetic.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "contct/number/double_double.hpp"
#include "contct/number/rational.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// Calls visit(element, force) for every loaded element of a beam. `force`: the work that all loads together
/// do on the shape functions of the element; each number is rounded once.
template <class Number>
void for_each_exact_work(const beam& b, const load& l,
                         const std::function<void(int, const std::array<Number, 4>&)>& visit);

/// The pressure on an element of a plate.
template <class Number>
struct summed_pressure {
  Number value{};
  /// Used instead of `value` if a load acts on only a part of the element: the work of all loads on the shape
  /// functions of the element.
  std::optional<std::array<Number, 12>> on_parts = {};
};
/// [elements] the pressure of all loads together, rounded once.
template <class Number>
[[nodiscard]] std::vector<summed_pressure<Number>> exact_pressures(const plate& p, const load& l);

/// [nodes] for a bed's parts: modulus times share, and the share, of each node.
struct bed_springs {
  rational_vector stiffness, share;
};
[[nodiscard]] bed_springs springs_of(const model& m, const std::vector<bed_part>& parts);
/// Where a bed acts on a beam, ascending, rounded: its parts, or the half elements at its nodes.
[[nodiscard]] std::vector<std::array<double, 2>> intervals_of(const bed& b, const beam& on);

/// A part of a beam's element along which the load is one polynomial. Each number is rounded once.
struct element_piece {
  double left, right;               ///< x of the ends of the piece
  double_double h, EI;              ///< length and bending stiffness
  std::vector<double_double> q;     ///< the load, in t from 0 to 1 along the piece, constant first
  double_double curvature;          ///< the imposed curvature: M = EI (w'' - curvature)
  double_double force{}, moment{};  ///< point loads at the left end of the piece
  double size = 0.0;                ///< the sum of the magnitudes of the loads, each as a force per length

  [[nodiscard]] bool is_plain() const { return curvature == 0.0 && force == 0.0 && moment == 0.0; }
};
/// The pieces of an element, from left to right. All elements up to `last` have the same pieces.
struct alike_pieces {
  int last;
  std::vector<element_piece> pieces;
};
/// The pieces of every loaded element of `b`. Key: the first of consecutive elements with the same pieces.
[[nodiscard]] std::map<int, alike_pieces> pieces_of(const beam& b, const load& l);
/// True if any load of `l` acts on an element: a load that others cancel at nodes, but not everywhere.
[[nodiscard]] bool acts_inside(const beam& b, const load& l);
/// The pieces of `element`; null if no load acts on this element.
[[nodiscard]] const std::vector<element_piece>* pieces_at(const std::map<int, alike_pieces>& all,
                                                          int element);

}  // namespace contct
