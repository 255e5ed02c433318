// Engineering results of a whole structure: a beam's exact line between its nodes, and the extremes of each
// quantity with their places.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "contct/model/placed_loads.hpp"
#include "contct/model/problem.hpp"

namespace contct {

/// An element of a beam, or a piece of one, exactly: the solution of EI w_xxxx = q with the displacements of
/// its nodes. Each quantity is a polynomial in t = (x - left) / h, from 0 to 1, constant first (see
/// polynomial_at).
struct element_line {
  double left = 0.0, h = 0.0, right = 0.0;
  std::vector<double> w, slope, moment, shear, load;
  double load_size = 0.0;  ///< the magnitudes of `load`, each of which is off by at most 2^-89 of it
  double curvature = 0.0;  ///< imposed
};

/// The lines of all elements under displacement `u` [dofs] and load `l`.
class beam_lines {
 public:
  /// `b` and `u` must outlive this object. `element_values`: values at the ends of elements, as in
  /// element_results, if more accurate ones than from `u` are known.
  beam_lines(const beam& b, const load& l, std::span<const double> u,
             std::span<const double> element_values = {});

  /// Element `e`, from 0, from its left end as if no load began, ended or stood inside.
  [[nodiscard]] element_line at(int e) const;
  /// The pieces of element `e` between the places where loads begin, end or stand: the element itself if
  /// there are none. A load at a place makes the shear or the moment jump there.
  [[nodiscard]] std::vector<element_line> pieces(int e) const;
  /// Has element `e` more than one, or an imposed curvature?
  [[nodiscard]] bool is_broken(int e) const;
  /// Shear and moment at the ends of the elements.
  [[nodiscard]] const element_results& ends() const { return ends_; }

 private:
  const beam& beam_;
  std::span<const double> u_;
  element_results ends_;
  std::vector<double> h_;  // of each element
  std::map<int, alike_pieces> pieces_;
};

/// The coefficients of a polynomial in Bernstein's form: from t = 0 to 1 it is between the least and the
/// largest of them.
[[nodiscard]] std::vector<double> bernstein_of(std::span<const double> polynomial);

/// The t inside an element at which w, the moment or the shear is extreme, in ascending order.
[[nodiscard]] std::vector<double> extreme_places(const element_line& line);

/// A value, and where it is: its place along the structure, and its node (from 0) where it is at one.
struct placed_value {
  double value = 0.0;
  double x = 0.0, y = 0.0;
  int node = -1;
};

/// The least and the largest value of one quantity.
struct value_range {
  std::string_view name;
  placed_value least, most;

  /// The larger of the two by magnitude.
  [[nodiscard]] const placed_value& largest() const { return -least.value > most.value ? least : most; }
};

/// The least and the largest deflection from node `first` to node `last` > `first`, between nodes too.
[[nodiscard]] value_range deflections_between(const beam& b, const beam_lines& lines,
                                              std::span<const double> u, int first, int last);

/// Beams: "w", "moment" and "shear" over the whole length, and "stress" where W is known. Plates: "w" at
/// nodes, "mx", "my" and "mxy" at the corners of elements, and "s1", "s2" and "von_mises" if the thickness is
/// known. A matrix: the displacements of the dofs among `deflecting`, as "w". Of equal values (to 1e-9 of
/// them), the first one's place. `element_values`: see beam_lines.
[[nodiscard]] std::vector<value_range> ranges_of(const model& m, const load& l, std::span<const double> u,
                                                 std::span<const int> deflecting,
                                                 std::span<const double> element_values = {});

/// Stresses at the extreme fibres: M / W at both ends of each element of a beam with a section modulus, as
/// "stress"; of a plate with a thickness "sx", "sy", "txy", principal "s1" >= "s2" and "von_mises" at the
/// corners of each element, sx = 6 m_x / t^2 and so on. Those of the lower fibre, or face, where sagging is
/// tension; at the upper one they have the other sign. Nothing if W, or the thickness, is unknown. `forces`:
/// results_in_elements.
[[nodiscard]] element_results stresses_of(const model& m, const element_results& forces);

/// What each of those stresses may be off by, and any along a beam, where no moment is off by more than
/// `moment` and no stress is larger than `largest`. Nothing where there are no stresses.
[[nodiscard]] std::optional<double> stress_error(const model& m, double moment, double largest);

}  // namespace contct
