#include "contct/path/factored_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/path/engine.hpp"
#include "contct/structure/cholesky.hpp"

namespace contct {

factored_stiffness::factored_stiffness(const linear_structure& s)
    : structure_(s),
      closed_(s.pairs.size()),
      work_(s.stiffness.order(), s.stiffness.subdiagonals()),
      ordered_(s.rows.size()) {}

void factored_stiffness::factor(std::span<const char> closed) {
  assemble(closed);
  if (!contct::factor(work_)) {
    throw no_factor(
        "the structure is held, but its stiffness matrix is too ill-conditioned to be factored "
        "in double precision");
  }
}

void factored_stiffness::solve(std::span<double> x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (structure_.fixed[i] != 0) x[i] = 0.0;
  }
  const std::vector<int>& rows = structure_.rows;
  if (rows.empty()) {
    solve_with(work_, x);
    return;
  }
  for (std::size_t i = 0; i < x.size(); ++i) ordered_[static_cast<std::size_t>(rows[i])] = x[i];
  solve_with(work_, ordered_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = ordered_[static_cast<std::size_t>(rows[i])];
}

void factored_stiffness::solve_refined(std::span<const double> right_hand_side, std::span<double> u) {
  std::copy(right_hand_side.begin(), right_hand_side.end(), u.begin());
  solve(u);
  constexpr int most_passes = 6;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  std::vector<double> correction(u.size());
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes; ++pass) {
    residual(right_hand_side, u, correction);
    solve(correction);
    double largest = 0.0;
    double size = 0.0;
    for (std::size_t dof = 0; dof < u.size(); ++dof) {
      const int row = structure_.row_of(static_cast<int>(dof));
      const double scale = std::sqrt(structure_.stiffness.at(row, row));
      largest = std::max(largest, scale * std::abs(correction[dof]));
      size = std::max(size, scale * std::abs(u[dof]));
    }
    if (!(largest < before / 2)) return;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += correction[i];
    if (largest <= eps / 2 * size) return;
    before = largest;
  }
}

/// What K and the closed springs leave of the right-hand side; every product and sum in long double.
void factored_stiffness::residual(std::span<const double> right_hand_side, std::span<const double> u,
                                  std::span<double> left) const {
  const auto row = [this](std::size_t dof) {
    return static_cast<std::size_t>(structure_.row_of(static_cast<int>(dof)));
  };
  std::vector<double> x(u.size());
  std::vector<long double> r(u.size());
  for (std::size_t dof = 0; dof < u.size(); ++dof) {
    x[row(dof)] = u[dof];
    r[row(dof)] = right_hand_side[dof];
  }
  structure_.stiffness.subtract_product(x, r);
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const auto dof = static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)));
    if (closed_[i] != 0) r[row(dof)] -= static_cast<long double>(structure_.pairs[i].stiffness) * u[dof];
  }
  for (std::size_t dof = 0; dof < u.size(); ++dof) left[dof] = static_cast<double>(r[row(dof)]);
}

double factored_stiffness::reciprocal_condition(std::span<const char> closed) {
  assemble(closed);
  return contct::reciprocal_condition(work_);
}

void factored_stiffness::assemble(std::span<const char> closed) {
  closed_.assign(closed.begin(), closed.end());
  std::copy_n(structure_.stiffness.data(),
              static_cast<std::size_t>(work_.order()) * static_cast<std::size_t>(work_.subdiagonals() + 1),
              work_.data());
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const int dof = structure_.dof_of_pair(static_cast<int>(i));
    if (closed_[i] != 0 && structure_.fixed[static_cast<std::size_t>(dof)] == 0) {
      work_.add(structure_.row_of(dof), structure_.row_of(dof), structure_.pairs[i].stiffness);
    }
  }
}

std::vector<double> with_pair_forces(const linear_structure& s, std::span<const double> load,
                                     std::span<const double> pair_forces) {
  std::vector<double> all(load.begin(), load.end());
  for (std::size_t i = 0; i < pair_forces.size(); ++i) {
    all[static_cast<std::size_t>(s.dof_of_pair(static_cast<int>(i)))] += pair_forces[i];
  }
  return all;
}

}  // namespace contct
