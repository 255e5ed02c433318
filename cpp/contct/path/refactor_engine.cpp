#include "contct/path/refactor_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/structure/cholesky.hpp"

namespace contct {

refactor_engine::refactor_engine(const linear_structure& s)
    : structure_(s),
      closed_(s.pairs.size()),
      work_(s.stiffness.order(), s.stiffness.subdiagonals()),
      ordered_(s.rows.size()) {
  for (std::size_t i = 0; i < s.pairs.size(); ++i) closed_[i] = s.pairs[i].closed ? 1 : 0;
}

void refactor_engine::switch_spring(int pair, bool closed) {
  closed_[static_cast<std::size_t>(pair)] = closed ? 1 : 0;
}

void refactor_engine::respond(const residual_load& residual, std::span<double> d_star) {
  factor_now();
  for (std::size_t i = 0; i < d_star.size(); ++i) d_star[i] = residual.share * residual.increment[i];
  solve(d_star);
}

void refactor_engine::recover(std::span<const double> load, std::span<const double> pair_forces,
                              std::span<double> u) {
  factor_now();
  std::copy(load.begin(), load.end(), u.begin());
  for (std::size_t i = 0; i < pair_forces.size(); ++i) {
    u[static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)))] += pair_forces[i];
  }
  const std::vector<double> right_hand_side(u.begin(), u.end());
  solve(u);
  refine(right_hand_side, u);
}

/// Newton's correction with the residual in long double, until it no longer helps: u then has the
/// digits that the stored matrix has, or 3 more than LAPACK alone where its condition takes more.
void refactor_engine::refine(std::span<const double> right_hand_side, std::span<double> u) {
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
void refactor_engine::residual(std::span<const double> right_hand_side, std::span<const double> u,
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

double refactor_engine::reciprocal_condition() {
  assemble();
  return contct::reciprocal_condition(work_);
}

void refactor_engine::assemble() {
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

void refactor_engine::factor_now() {
  assemble();
  if (!factor(work_)) {
    throw no_factor(
        "the structure is held, but its stiffness matrix is too ill-conditioned to be factored "
        "in double precision");
  }
}

void refactor_engine::solve(std::span<double> x) {
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

}  // namespace contct
