// Results for a whole structure: the deflected lines of beams, and the extremes of each quantity.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "contct/structure/placed_loads.hpp"
#include "contct/structure/statics.hpp"

namespace contct {

/// The coefficients of a polynomial along an element, constant first. Up to 14, as a bed_line has, are stored
/// without an allocation.
template <class Number>
using line_polynomial = boost::container::small_vector<Number, 14>;

/// The values at the left end of an element or of a piece.
template <class Number>
struct line_start {
  Number w, slope, moment, shear;
};

template <class Number>
// NOLINTNEXTLINE(bugprone-exception-escape): moving numbers throws nothing
struct line_of {
  line_polynomial<Number> w, slope, moment, shear;

  [[nodiscard]] line_start<Number> right_end() const {
    line_start<Number> end{};
    for (const Number& c : w) end.w += c;
    for (const Number& c : slope) end.slope += c;
    for (const Number& c : moment) end.moment += c;
    for (const Number& c : shear) end.shear += c;
    return end;
  }
};

/// Gives `line` its w, slope, moment and shear under the load q(t) and an imposed curvature. `flexibility` is
/// that by shear, 1 / GA.
template <class Line, class Number, class Coefficients>
void put_along(Line& line, const line_start<Number>& left, const Coefficients& q, const Number& h,
               const Number& EI, const Number& curvature, const Number& flexibility) {
  const auto [w, slope, moment, shear] = std::tie(line.w, line.slope, line.moment, line.shear);
  w.resize(q.size() + 4);
  moment.resize(q.size() + 2);
  shear.resize(q.size() + 1);
  shear[0] = left.shear;
  moment[0] = left.moment;
  moment[1] = left.shear * h;
  for (std::size_t j = 0; j < q.size(); ++j) {  // dV/dx = q, dM/dx = V
    const auto n = static_cast<double>(j);
    shear[j + 1] = q[j] * h / (n + 1);
    moment[j + 2] = q[j] * h * h / (n + 1) / (n + 2);
  }
  w[0] = left.w;
  w[1] = left.slope * h;
  for (std::size_t i = 0; i < moment.size(); ++i) {  // EI (w'' - curvature) = M
    const auto n = static_cast<double>(i);
    w[i + 2] = moment[i] * h * h / EI / (n + 1) / (n + 2);
  }
  w[2] += curvature * h * h / 2;
  for (std::size_t i = 1; i < w.size(); ++i) slope.push_back(w[i] * static_cast<double>(i) / h);
  for (std::size_t j = 0; j < shear.size() && flexibility != Number(0); ++j)  // dw/dx = slope - V / GA
    w[j + 1] -= shear[j] * h * flexibility / static_cast<double>(j + 1);
}

/// The exact deflected line of a beam's element or of a piece of an element: the solution of EI w_xxxx = q,
/// or of the same equations with shear flexibility, with the displacements of the nodes. `slope` is the
/// rotation of the section. Each quantity is a polynomial in t = (x - left) / h, from 0 to 1 (see
/// polynomial_at).
// NOLINTNEXTLINE(bugprone-exception-escape): moving numbers throws nothing
struct element_line {
  double left = 0.0, h = 0.0, right = 0.0;
  line_polynomial<double> w, slope, moment, shear, load;
  /// The sum of the magnitudes of the loads, each as a force per length, and in a broken element also of
  /// shear and moment: rounding errors are relative to load_size.
  double load_size = 0.0;
  double curvature = 0.0;  ///< the imposed curvature
};

/// The lines of all elements under displacement `u` [dofs] and load `l`.
class beam_lines {
 public:
  /// `b` and `u` must outlive this object. `element_values`: element_results::values, if more accurate ones
  /// than those computed from `u` are known.
  beam_lines(const beam& b, const load& l, std::span<const double> u,
             std::span<const double> element_values = {});

  /// The line of element `e` (from 0) as one piece. If is_broken(e), the line is computed without loads, and
  /// only its values at t = 0 are correct.
  [[nodiscard]] element_line at(int e) const;
  /// The pieces of element `e` between the places where a load begins, ends or acts at a point; the whole
  /// element if there are no such places. Shear or moment jumps where a load acts at a point.
  [[nodiscard]] std::vector<element_line> pieces(int e) const;
  /// True if element `e` has several pieces, a point force or moment at its left end, or imposed curvature.
  [[nodiscard]] bool is_broken(int e) const;
  /// Shear and moment at the ends of the elements.
  [[nodiscard]] const element_results& ends() const { return ends_; }

 private:
  const beam& beam_;
  std::span<const double> u_;
  element_results ends_;
  std::vector<double> h_;  // [elements]
  std::map<int, alike_pieces> pieces_;
};

/// The Bernstein coefficients of a polynomial. From t = 0 to 1 the polynomial lies between the least and the
/// largest Bernstein coefficient.
[[nodiscard]] line_polynomial<double> bernstein_of(const line_polynomial<double>& polynomial);

/// The places between 0 and 1, ascending, at which p changes its sign. Between neighbouring zeros of its
/// derivative, p changes its sign at most once.
[[nodiscard]] std::vector<double> zeros_of(const line_polynomial<double>& p);

/// The sum of the magnitudes of the coefficients.
[[nodiscard]] double sum_of_sizes(const line_polynomial<double>& p);

/// The values of t inside an element, ascending, at which w, the moment or the shear has an extreme.
[[nodiscard]] std::vector<double> extreme_places(const element_line& line);

/// A value with its coordinates, and with its node (from 0) if it is at a node.
struct placed_value {
  double value = 0.0;
  double x = 0.0, y = 0.0;
  int node = -1;
  std::string_view name = {};  ///< that the file gives to the support, pair or bed whose value it is
};

/// The difference up to which values of magnitude `size` are equal, as at symmetric places, if the quantity
/// has values of magnitude `largest`, and so rounding of that magnitude.
[[nodiscard]] inline double tie_of(double size, double largest) {
  return std::max(1e-9 * size, 0x1p-48 * largest);
}

/// The least and the largest value of one quantity.
struct value_range {
  std::string_view name;
  placed_value least, most;

  /// `least` or `most`, whichever has the larger magnitude; of equal magnitudes the positive value.
  [[nodiscard]] const placed_value& largest() const {
    return -least.value > (1 + 1e-9) * most.value ? least : most;
  }
};

/// The least and the largest deflection between node `first` and node `last` > `first`.
[[nodiscard]] value_range deflections_between(const beam_lines& lines, std::span<const double> u, int first,
                                              int last);

/// The extremes of each quantity. Beams: w, moment and shear over the whole length, and the stress if W is
/// known. Plates: w at nodes, the moments at the corners of elements, and the principal and von Mises
/// stresses if the thickness is known. A matrix: the displacements of the dofs in `deflecting`. If values are
/// equal (see tie_of), the place is that of the first. `element_values`: see beam_lines. `within`: only
/// places in this part of a beam or plate.
[[nodiscard]] std::vector<value_range> ranges_of(const model& m, const load& l, std::span<const double> u,
                                                 std::span<const int> deflecting,
                                                 std::span<const double> element_values = {},
                                                 const watched_part* within = nullptr);
/// Those of a beam, by its lines under displacement `u`.
[[nodiscard]] std::vector<value_range> ranges_of(const beam& b, const beam_lines& lines,
                                                 std::span<const double> u,
                                                 const watched_part* within = nullptr);

/// Stresses at the lower fibre or face, where sagging causes tension. For a beam: M / W at both ends of each
/// element. For a plate: sx = 6 m_x / t^2, sy and txy, the principal stresses s1 >= s2 and the von Mises
/// stress at the corners of each element. At the upper fibre or face, all but the last have the opposite
/// sign. Empty if W, or the thickness, is unknown. `forces`: results_in_elements.
[[nodiscard]] element_results stresses_of(const model& m, const element_results& forces);

/// A bound on the error of each stress from stresses_of, and of each stress along a beam, if no moment is
/// wrong by more than `moment` and no stress is larger than `largest`. Nothing if there are no stresses.
[[nodiscard]] std::optional<double> stress_error(const model& m, double moment, double largest);

}  // namespace contct
