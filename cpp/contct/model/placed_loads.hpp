// Loads that need not follow the mesh, in exact arithmetic: on parts of beams and plates, and at places of a
// beam between its nodes.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/number/double_double.hpp"

namespace contct {

/// Call visit(element, force) for every element of a beam that something acts on, with the work of all loads
/// together on its shape functions, each number rounded once.
template <class Number>
void for_each_exact_work(const beam& b, const load& l,
                         const std::function<void(int, const std::array<Number, 4>&)>& visit);

/// The pressure on an element of a plate.
template <class Number>
struct summed_pressure {
  Number value{};
  /// If some of the load acts only on a part of the element: the work of all of it on the shape functions.
  std::optional<std::array<Number, 12>> on_parts = {};
};
/// On every element, by all loads together, rounded once.
template <class Number>
[[nodiscard]] std::vector<summed_pressure<Number>> exact_pressures(const plate& p, const load& l);

/// A part of a beam's element along which everything that acts is one polynomial, rounded once.
struct element_piece {
  double left, right;               ///< x of its ends, those within the element
  double_double h, EI;              ///< its length and its stiffness
  std::vector<double_double> q;     ///< the load, in t from 0 to 1 along the piece, constant first
  double_double curvature;          ///< imposed: M = EI (w'' - curvature)
  double_double force{}, moment{};  ///< loads at its left end
  double size = 0.0;                ///< the magnitudes of its loads as one per length

  [[nodiscard]] bool is_plain() const { return curvature == 0.0 && force == 0.0 && moment == 0.0; }
};
/// The pieces of an element, from left to right, which are the same for all elements up to `last`.
struct alike_pieces {
  int last;
  std::vector<element_piece> pieces;
};
/// The pieces of every loaded element, by the first of the elements that are alike.
[[nodiscard]] std::map<int, alike_pieces> pieces_of(const beam& b, const load& l);
/// Null where nothing acts.
[[nodiscard]] const std::vector<element_piece>* pieces_at(const std::map<int, alike_pieces>& all,
                                                          int element);

}  // namespace contct
