#include "contct/path/refactor_engine.hpp"

#include <algorithm>

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
  solve(u);
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
