// The kinds of structures as true_system_of sees them: stiffness, loads and element values of each in pairs
// of doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "contct/certify/true_system.hpp"
#include "contct/structure/element_formulas.hpp"
#include "contct/structure/polynomials.hpp"

namespace contct::certify {

namespace formulas = structure::formulas;

/// Half of each interval beside a point.
inline long_vector tributary(const long_line& l) {
  long_vector lengths(l.x.size());
  for (std::size_t i = 0; i < l.h.size(); ++i) {
    lengths[i] += l.h[i] / 2;
    lengths[i + 1] += l.h[i] / 2;
  }
  return lengths;
}

inline double least_cube(const long_vector& lengths) {
  double least = std::numeric_limits<double>::infinity();
  for (const double_double& h : lengths) least = std::min(least, h.hi * h.hi * h.hi);
  return least;
}

/// Collects entries row by row.
class sparse_rows {
 public:
  explicit sparse_rows(std::size_t rows) : rows_(rows) {}

  /// The entry, which is 0 at first.
  double_double& at(int row, int column) {
    auto& entries = rows_[row];
    constexpr std::size_t of_a_beam = 6;
    if (entries.empty()) entries.reserve(of_a_beam);
    const auto place = std::ranges::lower_bound(entries, column, {}, &entry::column);
    if (place != entries.end() && place->column == column) return place->value;
    return entries.insert(place, {column, {}})->value;
  }

  /// Ends the collection.
  long_matrix packed() {
    long_matrix k;
    for (auto& row : rows_) {
      for (const entry& e : row) {
        k.columns.push_back(e.column);
        k.values.push_back(e.value);
      }
      k.starts.push_back(k.columns.size());
      row = {};
    }
    return k;
  }

 private:
  struct entry {
    int column;
    double_double value;
  };
  std::vector<std::vector<entry>> rows_;
};

template <class Matrix, class Dofs>
void add_element(sparse_rows& k, const Matrix& element, const Dofs& dofs) {
  for (std::size_t i = 0; i < dofs.size(); ++i)
    for (std::size_t j = 0; j < dofs.size(); ++j) k.at(dofs[i], dofs[j]) += element[i][j];
}

/// A structure of one kind: what the conversion of a problem asks of it.
class true_beam {
 public:
  explicit true_beam(const beam& b) : beam_(b), loads_(b), line_(loads_.line()) {
    for (const double EI : b.EI) EI_.push_back(long_decimal(EI));
  }

  void assemble(sparse_rows& k) const {
    std::array<std::array<double_double, 4>, 4> matrix;
    for (std::size_t e = 0; e < line_.h.size(); ++e) {
      if (!is_like_the_last(e)) matrix = formulas::beam_stiffness(EI_[e], line_.h[e]);
      add_element(k, matrix, dofs_of(e));
    }
  }

  void add_distributed(const load& l, true_loads& f) const {
    uniform_load last;
    loads_.for_each(l, [&](int e, const load_on_element& on) {
      const element_loads work = work_of(e, on, last);
      const std::array<int, 4> dofs = dofs_of(e);
      for (std::size_t i = 0; i < 4; ++i) {
        f.force[dofs[i]] += work.force[i];
        f.size[dofs[i]] += work.size * (i % 2 == 0 ? 1.0 : line_.h[e].hi);
      }
    });
  }

  /// From the rotations relative to the chord: the rigid motion of an element may be large.
  [[nodiscard]] std::vector<element_value> values(const load& l, std::span<const double_double> u) const {
    std::vector<element_value> all;
    all.reserve(4 * line_.h.size());
    double_double inverse;
    double_double stiffness;
    double of_shear = 0.0;
    double of_moment = 0.0;
    for (std::size_t e = 0; e < line_.h.size(); ++e) {
      if (!is_like_the_last(e)) {
        inverse = double_double(1.0) / line_.h[e];
        stiffness = 2 * EI_[e] * inverse;
        of_shear = std::sqrt(6 * stiffness.hi) / line_.h[e].hi;
        of_moment = std::sqrt(2 * stiffness.hi);
      }
      const double_double chord = (u[2 * e + 2] - u[2 * e]) * inverse;
      const double_double left = u[2 * e + 1] - chord;
      const double_double right = u[2 * e + 3] - chord;
      const double_double m1 = stiffness * (2 * left + right);
      const double_double m2 = stiffness * (left + 2 * right);
      const double_double v = (m1 + m2) * inverse;
      const double m =
          3 * stiffness.hi * (std::abs(u[2 * e + 1].hi) + std::abs(u[2 * e + 3].hi) + 2 * std::abs(chord.hi));
      const double q = 2 * m / line_.h[e].hi;
      all.insert(all.end(), {{v, q, of_shear, false},
                             {v, q, of_shear, false},
                             {-m1, m, of_moment, true},
                             {m2, m, of_moment, true}});
    }
    uniform_load last;
    loads_.for_each(l, [&](int e, const load_on_element& on) {
      const element_loads work = work_of(e, on, last);
      const std::array<double_double, 4> added = {-work.force[0], work.force[2], work.force[1],
                                                  -work.force[3]};
      element_value* const of_element = &all[4 * static_cast<std::size_t>(e)];
      for (std::size_t i = 0; i < 4; ++i) {
        of_element[i].value += added[i];
        of_element[i].size += work.size * (i < 2 ? 1.0 : line_.h[e].hi);
      }
    });
    return all;
  }

  [[nodiscard]] long_vector shares() const { return tributary(line_); }
  [[nodiscard]] long_vector faces_at(std::span<const int> nodes, std::span<const double> polynomial) const {
    return structure::values_at(beam_, polynomial, nodes);
  }
  [[nodiscard]] double span() const { return beam_.x.back() - beam_.x.front(); }
  [[nodiscard]] double least_product() const {
    return std::min(least_cube(line_.h), std::ranges::min(beam_.EI));
  }

 private:
  struct element_loads {
    std::array<double_double, 4> force;
    double size = 0.0;
  };
  /// A constant load, and what it comes to on an element of some length.
  struct uniform_load {
    double_double q, h;
    element_loads work;
  };

  [[nodiscard]] bool is_like_the_last(std::size_t e) const {
    return e > 0 && line_.h[e] == line_.h[e - 1] && EI_[e] == EI_[e - 1];
  }

  /// `last`: of the element before, which is often the same.
  [[nodiscard]] element_loads work_of(std::size_t e, const load_on_element& on, uniform_load& last) const {
    const double_double& h = line_.h[e];
    if (on.q.size() == 1 && last.q == on.q[0] && last.h == h) return last.work;
    const element_loads work{formulas::beam_load<double_double>(on.q, h), on.size * h.hi};
    if (on.q.size() == 1) last = {on.q[0], h, work};
    return work;
  }

  static std::array<int, 4> dofs_of(std::size_t e) {
    const int first = 2 * static_cast<int>(e);
    return {first, first + 1, first + 2, first + 3};
  }

  const beam& beam_;
  loads_on_elements loads_;
  long_line line_;
  long_vector EI_;
};

class true_plate {
 public:
  explicit true_plate(const plate& p)
      : plate_(p),
        x_(line_of(p.x, p.x_runs)),
        y_(line_of(p.y, p.y_runs)),
        D_(stiffness_of(p)),
        nu_(long_decimal(p.nu)) {}

  void assemble(sparse_rows& k) const {
    true_element_stiffness stiffness(plate_);
    for (int e = 0; e < plate_.elements(); ++e) add_element(k, stiffness(e), plate_.dofs_of(e));
  }

  void add_distributed(const load& l, true_loads& f) const {
    for (const distributed_load& d : l.distributed) {
      const double_double pressure = long_polynomial_of(d)[0];
      for_each_loaded_element({{}, {d}}, plate_.elements(), [&](int e, std::span<const double> /*rounded*/) {
        const halves size = halves_of(e);
        const auto unit = formulas::plate_unit_load(size.a, size.b);
        const std::array<int, 12> dofs = plate_.dofs_of(e);
        for (std::size_t i = 0; i < 12; ++i) {
          const double_double part = pressure * unit[i];
          f.force[dofs[i]] += part;
          f.size[dofs[i]] += std::abs(part.hi);
        }
      });
    }
  }

  /// Moments at the corners: w_xx and w_yy are bilinear and w_xy has five terms, so a corner's value is at
  /// most 4 and sqrt(17) times its root mean square over the element, which the energy bounds.
  [[nodiscard]] std::vector<element_value> values(const load& /*l*/, std::span<const double_double> u) const {
    std::vector<element_value> all;
    for (int e = 0; e < plate_.elements(); ++e) {
      const halves size = halves_of(e);
      const std::array<int, 12> dofs = plate_.dofs_of(e);
      const double area = 4 * size.a.hi * size.b.hi;
      const double bends = 4 * std::sqrt(D_.hi / area);
      const double twists = std::sqrt(17 * D_.hi * (1 - nu_.hi) / (2 * area));
      const auto at = curvatures(size, dofs, u);
      const double_double twice = (1 - nu_) * D_;
      for (const auto& c : at)
        all.push_back({D_ * (c.xx + nu_ * c.yy), D_.hi * (c.xx_size + c.yy_size), bends, true});
      for (const auto& c : at)
        all.push_back({D_ * (c.yy + nu_ * c.xx), D_.hi * (c.xx_size + c.yy_size), bends, true});
      for (const auto& c : at) all.push_back({twice * c.xy, 2 * D_.hi * c.xy_size, twists, true});
    }
    return all;
  }

  /// Faces of a plate's beds are no polynomials, and matrices have no beds.
  [[nodiscard]] static long_vector faces_at(std::span<const int> nodes,
                                            std::span<const double> /*polynomial*/) {
    return long_vector(nodes.size());
  }
  [[nodiscard]] long_vector shares() const {
    long_vector areas;
    for (const double_double& height : tributary(y_))
      for (const double_double& width : tributary(x_)) areas.push_back(width * height);
    return areas;
  }
  [[nodiscard]] double least_product() const { return std::min({least_cube(x_.h), least_cube(y_.h), D_.hi}); }
  [[nodiscard]] double span() const {
    return std::max(plate_.x.back() - plate_.x.front(), plate_.y.back() - plate_.y.front());
  }

 private:
  struct halves {
    double_double a, b;
  };
  struct curvature {
    double_double xx, yy, xy;
    double xx_size = 0.0, yy_size = 0.0, xy_size = 0.0;
  };

  [[nodiscard]] static std::array<curvature, 4> curvatures(const halves& size,
                                                           const std::array<int, 12>& dofs,
                                                           std::span<const double_double> u) {
    std::array<curvature, 4> all;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto c =
          formulas::curvatures_at<double_double>(formulas::corners[k].xi, formulas::corners[k].eta);
      for (std::size_t i = 0; i < 12; ++i) {
        const double_double scaled = i % 3 == 0 ? u[dofs[i]] : u[dofs[i]] * (i % 3 == 1 ? size.a : size.b);
        const auto add = [&](double_double& sum, double& magnitude, const double_double& part) {
          sum += part;
          magnitude += std::abs(part.hi);
        };
        add(all[k].xx, all[k].xx_size, c.xx[i] * scaled / (size.a * size.a));
        add(all[k].yy, all[k].yy_size, c.yy[i] * scaled / (size.b * size.b));
        add(all[k].xy, all[k].xy_size, c.xy[i] * scaled / (size.a * size.b));
      }
    }
    return all;
  }

  [[nodiscard]] halves halves_of(int element) const {
    const int i = element % (plate_.columns() - 1);
    const int j = element / (plate_.columns() - 1);
    return {x_.h[i] / 2, y_.h[j] / 2};
  }

  const plate& plate_;
  long_line x_, y_;
  double_double D_, nu_;
};

class true_matrix {
 public:
  explicit true_matrix(const assembled& a) : assembled_(a) {}

  void assemble(sparse_rows& k) const {
    for (const matrix_entry& m : assembled_.stiffness.entries) {
      const double_double value = long_decimal(m.value);
      k.at(m.row, m.column) += value;
      if (m.row != m.column) k.at(m.column, m.row) += value;
    }
  }
  void add_distributed(const load& /*l*/, true_loads& /*f*/) const {}
  [[nodiscard]] static std::vector<element_value> values(const load& /*l*/,
                                                         std::span<const double_double> /*u*/) {
    return {};
  }
  [[nodiscard]] long_vector shares() const { return long_vector(assembled_.stiffness.order); }
  [[nodiscard]] static long_vector faces_at(std::span<const int> nodes,
                                            std::span<const double> /*polynomial*/) {
    return long_vector(nodes.size());
  }
  [[nodiscard]] static double span() { return 0.0; }
  [[nodiscard]] static double least_product() { return 1.0; }

 private:
  const assembled& assembled_;
};

}  // namespace contct::certify
