// The rounding that a state at the end of a path in doubles may have.
#pragma once

#include <algorithm>
#include <cmath>

#include "contct/proof/long_system.hpp"
#include "contct/results/run_result.hpp"

namespace contct {

/// Bounds on the rounding of the numbers of a state. A path in doubles solves, in each step, equations whose
/// row i is off by at most g_i: `share` times the sum of the magnitudes of the row's terms (loads, K_ij u_j
/// with prescribed displacements, contact forces). The least eigenvalue of S K_A S, with 1 on the diagonal,
/// is at least its reciprocal condition, so the state is off by at most rho = |S g| / sqrt(rcond) in the norm
/// of K_A. Bounds on numbers follow from rho as in reference/certificate-proof.md; each number also has the
/// rounding of its own terms. The rho of successive steps are added until a step starts from zero.
class path_rounding {
 public:
  /// `p` must outlive this object.
  explicit path_rounding(const problem& p) : system_(long_system_of(p)) {}

  /// Adds the next step. The functions below are about the end of this step.
  void add(const solved_step& s) {
    const long_loads& loads = system_.at_end_of(s.step);
    if (loads.from_zero) {
      rho_ = 0.0;
      rcond_ = 1.0;
    }
    u_.assign(s.displacement.begin(), s.displacement.end());
    elements_ = system_.element_values(s.step, u_);
    noise_ = system_.residual(u_, loads).slack;  // 2 long_rounding times the sum of the magnitudes
    diagonal_.clear();
    for (const double root : system_.root) diagonal_.push_back(root * root);
    for (std::size_t i = 0; i < system_.pairs.size(); ++i)
      if (const long_pair& p = system_.pairs[i]; s.closed(i))
        for (const int dof : {p.dof, p.other})
          if (dof >= 0) diagonal_[dof] += p.stiffness.hi;
    double square = 0.0;
    for (std::size_t dof = 0; dof < diagonal_.size(); ++dof) {
      noise_[dof] *= share / (2 * long_rounding);
      if (system_.fixed[dof] == 0) square += noise_[dof] * noise_[dof] / diagonal_[dof];
    }
    rcond_ = std::min(rcond_, s.rcond);
    rho_ += std::sqrt(square / s.rcond);
  }

  [[nodiscard]] double of_displacement(std::size_t dof) const {
    const double own = share * std::abs(u_[dof].hi);
    return system_.fixed[dof] != 0 ? own : own + rho_ / std::sqrt(diagonal_[dof] * rcond_);
  }
  [[nodiscard]] double of_pair(std::size_t pair) const {
    const long_pair& p = system_.pairs[pair];
    const double reach = of_displacement(p.dof) + (p.other < 0 ? 0.0 : of_displacement(p.other));
    return of_spring(p.stiffness.hi, reach) + share * p.stiffness.hi * system_.size_of_depth(pair, u_);
  }
  [[nodiscard]] double of_support(std::size_t support) const {
    const auto& s = system_.supports[support];
    if (s.fixed) return system_.root[s.dof] * rho_ + noise_[s.dof];
    return of_spring(s.spring.hi, of_displacement(s.dof)) + share * s.spring.hi * std::abs(u_[s.dof].hi);
  }
  /// `value`: as in element_results.
  [[nodiscard]] double of_element(std::size_t value) const {
    return elements_[value].energy * rho_ + share * elements_[value].size;
  }

 private:
  /// Allows for the constants of a band's factorisation, and for several solves in a step.
  static constexpr double share = 16 * 0x1p-53;

  [[nodiscard]] double of_spring(double stiffness, double reach) const {
    return std::min(std::sqrt(stiffness) * rho_, stiffness * reach);
  }

  long_system system_;
  long_vector u_;
  std::vector<double> noise_;     // the sum of the magnitudes in each row, times `share` [dofs]
  std::vector<double> diagonal_;  // of K_A [dofs]
  std::vector<element_value> elements_;
  double rho_ = 0.0, rcond_ = 1.0;
};

}  // namespace contct
