// The elements of beams and plates: stiffness, loads and results. `Number` is double, double_double or
// rational. equations_of and `build` assemble a structure from these classes.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

#include "contct/structure/element_formulas.hpp"
#include "contct/structure/line.hpp"
#include "contct/structure/placed_loads.hpp"

namespace contct {

/// The work of loads on the shape functions of one element. `size`: for each number of `force`, the sum of
/// the magnitudes of its terms; see size_of.
template <class Number, std::size_t Dofs>
struct element_work {
  std::array<int, Dofs> dofs{};
  std::array<Number, Dofs> force{};
  std::array<double, Dofs> size{};
};

template <class Number>
class beam_elements {
 public:
  /// `b` must outlive this object.
  explicit beam_elements(const beam& b) : beam_(b), h_(line<Number>(b.x, b.runs).lengths()) {
    for (int e = 0; e < b.elements(); ++e)  // most beams have one stiffness
      EI_.push_back(e > 0 && b.is_alike(e, e - 1) ? EI_.back() : stiffness_of<Number>(b, e));
    for (int e = 0; e < b.elements() && !b.GA.empty(); ++e)
      phi_.push_back(e > 0 && are_alike(e, e - 1)
                         ? phi_.back()
                         : Number(12 * EI_[e] * shear_flexibility_of<Number>(b, e) / h_[e] / h_[e]));
  }

  [[nodiscard]] int count() const { return beam_.elements(); }
  [[nodiscard]] const std::vector<Number>& lengths() const { return h_; }
  [[nodiscard]] const Number& EI(int e) const { return EI_[e]; }
  [[nodiscard]] Number phi(int e) const { return phi_.empty() ? Number(0) : phi_[e]; }
  [[nodiscard]] static std::array<int, 4> dofs_of(int e) { return {2 * e, 2 * e + 1, 2 * e + 2, 2 * e + 3}; }
  [[nodiscard]] bool are_alike(int e, int other) const {
    return h_[e] == h_[other] && beam_.is_alike(e, other) && is_released(e) == is_released(other) &&
           beam_.stiffness_of_hinge(e + 1) == beam_.stiffness_of_hinge(other + 1);
  }
  /// True if the element has a hinge at its right end.
  [[nodiscard]] bool is_released(int e) const { return beam_.has_hinge(e + 1); }
  [[nodiscard]] std::array<std::array<Number, 4>, 4> stiffness(int e) const {
    auto k = formulas::beam_stiffness(EI(e), h_[e], phi(e));
    if (!is_released(e)) return k;
    const auto shares = connection_of(e);
    const auto released = formulas::released_stiffness(EI(e), h_[e], phi(e));
    for (std::size_t i = 0; i < k.size(); ++i) k[i] = shares.between(k[i], released[i]);
    return k;
  }

  /// Calls visit(element, work) once for each loaded element, with the work of all its loads. In doubles, if
  /// no load is placed and without shear flexibility: once for each distributed load and each element that it
  /// acts on.
  template <class Visit>
  void for_each_work(const load& l, const Visit& visit) const {
    if constexpr (std::is_same_v<Number, double>) {
      if (l.placed.empty() && phi_.empty())
        return for_each_loaded_element(l, count(), [&](int e, std::span<const double> polynomial) {
          const auto force = formulas::beam_load_between(polynomial, beam_.x[e], h_[e]);
          visit(e, condensed(e, {dofs_of(e), force, {}}));
        });
    }
    for_each_exact_work<Number>(beam_, l, [&](int e, const std::array<Number, 4>& force) {
      element_work<Number, 4> work{dofs_of(e), force, {}};
      for (std::size_t i = 0; i < 4; ++i) work.size[i] = size_of(force[i]);
      visit(e, condensed(e, work));
    });
  }

  /// [elements] shear at the left and right end, then moment at the left and right end.
  [[nodiscard]] std::vector<std::array<Number, 4>> end_forces(const load& l,
                                                              std::span<const Number> u) const {
    std::vector<std::array<Number, 4>> forces;
    forces.reserve(h_.size());
    for (int e = 0; e < count(); ++e) forces.push_back(forces_of(e, u.subspan(2 * e).template first<4>()));
    for_each_work(l, [&](int e, const element_work<Number, 4>& work) {
      forces[e][0] -= work.force[0];
      forces[e][1] += work.force[2];
      forces[e][2] += work.force[1];
      forces[e][3] -= work.force[3];
    });
    return forces;
  }

  /// names, places and values: the members of element_results.
  [[nodiscard]] static std::vector<std::string_view> names() { return {"shear", "moment"}; }
  [[nodiscard]] static std::vector<std::string_view> stress_names() { return {"stress"}; }
  static constexpr int places = 2;
  [[nodiscard]] std::vector<Number> values(const load& l, std::span<const Number> u) const {
    std::vector<Number> all;
    for (const auto& of_element : end_forces(l, u))
      all.insert(all.end(), of_element.begin(), of_element.end());
    return all;
  }

  /// Adds to `need` [dofs] the forces of adjacent elements, minus the loads on these elements.
  void add_needs(const load& l, std::span<const Number> u, std::span<Number> need) const {
    const auto forces = end_forces(l, u);
    for (std::size_t e = 0; e < forces.size(); ++e) {
      const auto& [left_shear, right_shear, left_moment, right_moment] = forces[e];
      need[2 * e] += left_shear;
      need[2 * e + 1] -= left_moment;
      need[2 * e + 2] -= right_shear;
      need[2 * e + 3] += right_moment;
    }
  }

  /// The tributary length of each node.
  [[nodiscard]] std::vector<Number> shares() const { return tributary_lengths<Number>(h_); }

 private:
  /// How a hinge of stiffness s connects the right end of an element to the node, with k = K_44 of the
  /// element: the end turns by s / (s + k) of the node's theta plus k / (s + k) of its rotation without a
  /// moment. Stiffness and forces, which are linear in this rotation, have the same shares.
  struct connection {
    Number full, released;

    [[nodiscard]] std::array<Number, 4> between(const std::array<Number, 4>& connected,
                                                const std::array<Number, 4>& free) const {
      if (full == Number(0)) return free;
      std::array<Number, 4> all{};
      for (std::size_t i = 0; i < 4; ++i) all[i] = full * connected[i] + released * free[i];
      return all;
    }
  };
  [[nodiscard]] connection connection_of(int e) const {
    const double stiffness = beam_.stiffness_of_hinge(e + 1);
    if (stiffness == 0.0) return {Number(0), Number(1)};
    const auto s = number_of<Number>(stiffness);
    const Number k = formulas::beam_stiffness(EI(e), h_[e], phi(e))[3][3];
    return {s / (s + k), k / (s + k)};
  }
  [[nodiscard]] std::array<Number, 4> forces_of(int e, std::span<const Number, 4> u) const {
    const auto connected = formulas::beam_end_forces<Number>(EI(e), h_[e], phi(e), u);
    if (!is_released(e)) return connected;
    return connection_of(e).between(connected,
                                    formulas::released_end_forces<Number>(EI(e), h_[e], phi(e), u));
  }
  /// Returns `work` after condensing out the load on a released right end.
  [[nodiscard]] element_work<Number, 4> condensed(int e, element_work<Number, 4> work) const {
    if (!is_released(e)) return work;
    const std::array<Number, 3> shares = formulas::released_shares<Number>(h_[e], phi(e));
    std::array<double, 3> sizes = formulas::released_shares<double>(beam_.length_of(e), 0.0);
    if (!phi_.empty()) sizes[1] = 1.0;  // |2 - phi| < 4 + phi
    const connection c = connection_of(e);
    for (std::size_t i = 0; i < 3; ++i) {
      work.force[i] -= c.released * shares[i] * work.force[3];
      work.size[i] += std::abs(sizes[i]) * work.size[3];
    }
    if (c.full == Number(0)) work.size[3] = 0.0;
    work.force[3] = c.full * work.force[3];
    return work;
  }

  const beam& beam_;
  std::vector<Number> h_, EI_;
  std::vector<Number> phi_;  // see formulas::beam_stiffness; empty without shear flexibility
};

template <class Number>
class plate_elements {
 public:
  using vector = std::array<Number, 12>;

  /// Half the width and half the height of an element.
  struct halves {
    Number a, b;
  };

  /// `p` must outlive this object.
  explicit plate_elements(const plate& p)
      : plate_(p),
        width_(line<Number>(p.x, p.x_runs).lengths()),
        height_(line<Number>(p.y, p.y_runs).lengths()),
        D_(stiffness_of<Number>(p)),
        nu_(number_of<Number>(p.nu)) {}

  [[nodiscard]] int count() const { return plate_.elements(); }
  [[nodiscard]] const Number& D() const { return D_; }
  [[nodiscard]] const Number& nu() const { return nu_; }
  [[nodiscard]] std::array<int, 12> dofs_of(int e) const { return plate_.dofs_of(e); }
  [[nodiscard]] halves halves_of(int e) const {
    return {width_[e % (plate_.columns() - 1)] / 2, height_[e / (plate_.columns() - 1)] / 2};
  }

  [[nodiscard]] bool are_alike(int e, int other) const {
    const halves own = halves_of(e);
    const halves others = halves_of(other);
    return own.a == others.a && own.b == others.b;
  }
  [[nodiscard]] std::array<vector, 12> stiffness(int e) const {
    const halves own = halves_of(e);
    return formulas::plate_stiffness(own.a, own.b, D_, nu_);
  }

  /// [elements] the pressure of all loads together.
  [[nodiscard]] std::vector<summed_pressure<Number>> pressures(const load& l) const {
    if (!std::is_same_v<Number, double> || !l.placed.empty()) return exact_pressures<Number>(plate_, l);
    std::vector<summed_pressure<Number>> sums(count());
    for_each_loaded_element(l, count(), [&](int e, std::span<const double> q) {
      if (q.size() != 1) throw std::invalid_argument("the pressure on a plate's element must be constant");
      sums[e].value += q[0];
    });
    return sums;
  }

  /// If there are loads, calls visit(element, work) for every element, with the work of all loads on it.
  template <class Visit>
  void for_each_work(const load& l, const Visit& visit) const {
    if (l.distributed.empty() && l.placed.empty()) return;
    const std::vector<summed_pressure<Number>> pressure = pressures(l);
    for (int e = 0; e < count(); ++e) visit(e, work_on(e, pressure[e]));
  }

  [[nodiscard]] vector displacement(int e, std::span<const Number> u) const {
    vector own;
    std::size_t next = 0;
    for (const int dof : dofs_of(e)) own[next++] = u[dof];
    return own;
  }
  /// The bending deformation of element `e`: see plate_deformation.
  [[nodiscard]] vector deformation(int e, std::span<const Number> u) const {
    const halves own = halves_of(e);
    return formulas::plate_deformation(own.a, own.b, displacement(e, u));
  }
  /// The nodal forces that hold element `e` at the displacements `u`.
  [[nodiscard]] vector forces(int e, std::span<const Number> u) const {
    const halves own = halves_of(e);
    return formulas::plate_forces(own.a, own.b, D_, nu_, displacement(e, u));
  }
  /// M_x, M_y and M_xy at the corners of element `e`: see element_results.
  [[nodiscard]] std::array<std::array<Number, 4>, 3> moments(int e, std::span<const Number> u) const {
    const halves own = halves_of(e);
    const auto at = formulas::curvatures_at_corners(own.a, own.b, deformation(e, u));
    std::array<std::array<Number, 4>, 3> m{};
    for (std::size_t k = 0; k < 4; ++k) {
      m[0][k] = D_ * (at[k].xx + nu_ * at[k].yy);
      m[1][k] = D_ * (at[k].yy + nu_ * at[k].xx);
      m[2][k] = D_ * (1 - nu_) * at[k].xy;
    }
    return m;
  }

  /// names, places and values: the members of element_results.
  [[nodiscard]] static std::vector<std::string_view> names() { return {"mx", "my", "mxy"}; }
  [[nodiscard]] static std::vector<std::string_view> stress_names() {
    return {"sx", "sy", "txy", "s1", "s2", "von_mises"};
  }
  static constexpr int places = 4;
  [[nodiscard]] std::vector<Number> values(const load& /*l*/, std::span<const Number> u) const {
    std::vector<Number> all;
    for (int e = 0; e < count(); ++e)
      for (const auto& quantity : moments(e, u)) all.insert(all.end(), quantity.begin(), quantity.end());
    return all;
  }

  /// Adds to `need` [dofs] the forces of adjacent elements, minus the loads on these elements.
  void add_needs(const load& l, std::span<const Number> u, std::span<Number> need) const {
    const std::vector<summed_pressure<Number>> pressure = pressures(l);
    for (int e = 0; e < count(); ++e) {
      const vector held = forces(e, u);
      const element_work<Number, 12> work = work_on(e, pressure[e]);
      for (std::size_t i = 0; i < 12; ++i) {
        need[work.dofs[i]] += held[i];
        need[work.dofs[i]] -= work.force[i];
      }
    }
  }

  /// The tributary area of each node: a quarter of each adjacent element.
  [[nodiscard]] std::vector<Number> shares() const {
    std::vector<Number> areas;
    areas.reserve(plate_.nodes());
    const std::vector<Number> widths = tributary_lengths<Number>(width_);
    for (const Number& height : tributary_lengths<Number>(height_))
      for (const Number& width : widths) areas.push_back(width * height);
    return areas;
  }

 private:
  [[nodiscard]] element_work<Number, 12> work_on(int e, const summed_pressure<Number>& pressure) const {
    const halves own = halves_of(e);
    const vector unit = formulas::plate_unit_load(own.a, own.b);
    element_work<Number, 12> work{dofs_of(e), {}, {}};
    for (std::size_t i = 0; i < 12; ++i) {
      work.force[i] = pressure.on_parts ? (*pressure.on_parts)[i] : pressure.value * unit[i];
      work.size[i] = pressure.on_parts ? size_of(work.force[i]) : size_of(pressure.value) * size_of(unit[i]);
    }
    return work;
  }

  const plate& plate_;
  std::vector<Number> width_, height_;  // [columns], [rows] of elements
  Number D_, nu_;
};

/// The elements of a structure given by its matrix: none, and no lengths or areas.
template <class Number>
struct no_elements {
  template <class Visit>
  void for_each_work(const load& /*l*/, const Visit& /*visit*/) const {}
  [[nodiscard]] static std::vector<Number> shares() { return {}; }
  [[nodiscard]] static std::vector<std::string_view> names() { return {}; }
  static constexpr int places = 0;
  [[nodiscard]] static std::vector<Number> values(const load& /*l*/, std::span<const Number> /*u*/) {
    return {};
  }
};

template <class Number>
[[nodiscard]] beam_elements<Number> elements_of(const beam& b) {
  return beam_elements<Number>(b);
}
template <class Number>
[[nodiscard]] plate_elements<Number> elements_of(const plate& p) {
  return plate_elements<Number>(p);
}
template <class Number>
[[nodiscard]] no_elements<Number> elements_of(const assembled& /*a*/) {
  return {};
}

/// Calls add(element, dofs, stiffness) for every element.
template <class Elements, class Add>
void for_each_stiffness(const Elements& elements, const Add& add) {
  decltype(elements.stiffness(0)) own{};
  for (int e = 0; e < elements.count(); ++e) {
    if (e == 0 || !elements.are_alike(e, e - 1)) own = elements.stiffness(e);
    add(e, elements.dofs_of(e), own);
  }
}

}  // namespace contct
