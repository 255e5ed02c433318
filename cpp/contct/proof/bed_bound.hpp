// The bound on the distance between the line w1 and the beam itself: A, rho and X of reference/mesh-error.md.
#pragma once

#include <string>
#include <vector>

#include "contct/proof/bed_line.hpp"

namespace contct {

/// A bound on the depth d of a bed where P and d have different signs.
[[nodiscard]] double wrong_in(const line_part& part, const bed_along& b, const line_polynomial<double>& d);

class bed_bound {
 public:
  /// `line`, which is settled, must outlive this object.
  explicit bed_bound(bed_line& line);

  /// Proves A, which is stored in `line`, and rho and X. Returns why this failed, or "".
  [[nodiscard]] std::string find();

  [[nodiscard]] double rho() const { return rho_; }
  /// r_d, and the forces of fixed dofs.
  [[nodiscard]] const long_residual& left() const { return left_; }
  /// The error of a dof is at most reach * rho.
  [[nodiscard]] double reach(std::size_t dof) const {
    return system_.fixed[dof] != 0 ? 0.0 : scale_[dof] * root_;
  }
  /// The same of w in an element.
  [[nodiscard]] double reach_in(const line_element& on) const;
  /// Bounds on the errors of moment and shear at an end of an element, or inside, without rounding.
  [[nodiscard]] double of_moment(const line_element& on, bool inside) const;
  [[nodiscard]] double of_shear(const line_element& on, bool inside) const;

 private:
  void measure();
  [[nodiscard]] bool hold();
  void sum_up();
  [[nodiscard]] bool shrink();

  bed_line& line_;
  const long_system& system_;
  const long_residual left_;
  std::vector<double> scale_;        // S of K_A
  double root_ = 0.0;                // sqrt((1 + eta) / mu)
  double rho_ = 0.0, forces_ = 0.0;  // forces_: X
};

}  // namespace contct
