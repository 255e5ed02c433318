#include "contct/solve/factored_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "contct/matrix/band_solve.hpp"
#include "contct/solve/engine.hpp"
#include "contct/solve/refine.hpp"

namespace contct {

namespace {

std::optional<stiffness_matrix> entries_of(const linear_structure& s, bool dissected) {
  if (!dissected || !s.stiffness.is_band()) return {};
  return columns_of(s.stiffness.band());
}

}  // namespace

factored_stiffness::factored_stiffness(const linear_structure& s, bool dissected)
    : structure_(s),
      entries_(entries_of(s, dissected)),
      closed_(s.pairs.size()),
      factor_(entries_ ? *entries_ : s.stiffness),
      ordered_(s.rows.size()) {}

void factored_stiffness::factor(std::span<const char> closed) {
  closed_.assign(closed.begin(), closed.end());
  if (!factor_.factor(springs(closed))) {
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
    factor_.solve(x);
    return;
  }
  for (std::size_t i = 0; i < x.size(); ++i) ordered_[static_cast<std::size_t>(rows[i])] = x[i];
  factor_.solve(ordered_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = ordered_[static_cast<std::size_t>(rows[i])];
}

void factored_stiffness::solve_unit(int dof, std::span<double> x) {
  if (structure_.fixed[static_cast<std::size_t>(dof)] != 0) return;
  if (entries_ || !structure_.stiffness.is_band()) {
    x[static_cast<std::size_t>(dof)] = 1.0;
    return solve(x);
  }
  const int row = structure_.row_of(dof);
  const std::vector<int>& rows = structure_.rows;
  if (rows.empty()) {
    x[static_cast<std::size_t>(row)] = 1.0;
    return solve_from(factor_.band(), row, x);
  }
  std::fill(ordered_.begin(), ordered_.end(), 0.0);
  ordered_[static_cast<std::size_t>(row)] = 1.0;
  solve_from(factor_.band(), row, ordered_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = ordered_[static_cast<std::size_t>(rows[i])];
}

void factored_stiffness::solve_units(std::span<const int> dofs, std::vector<double>& x) {
  std::vector<int> rows;
  for (const int dof : dofs)
    rows.push_back(structure_.fixed[static_cast<std::size_t>(dof)] != 0 ? -1 : structure_.row_of(dof));
  factor_.solve_units(rows, x);
}

void factored_stiffness::solve_refined(std::span<const double> right_hand_side, std::span<double> u) {
  std::copy(right_hand_side.begin(), right_hand_side.end(), u.begin());
  solve(u);
  const auto scale = [this](std::size_t dof) {
    return std::sqrt(structure_.stiffness.diagonal(structure_.row_of(static_cast<int>(dof))));
  };
  refine(u, scale, [this, right_hand_side](std::span<const double> x, std::span<double> correction) {
    residual(right_hand_side, x, correction);
    solve(correction);
  });
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
  structure_.stiffness.subtract_product(std::span<const double>(x), r);
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const auto dof = static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)));
    if (closed_[i] != 0) r[row(dof)] -= static_cast<long double>(structure_.pairs[i].stiffness) * u[dof];
  }
  for (std::size_t dof = 0; dof < u.size(); ++dof) left[dof] = static_cast<double>(r[row(dof)]);
}

double factored_stiffness::reciprocal_condition(std::span<const char> closed) {
  closed_.assign(closed.begin(), closed.end());
  return factor_.reciprocal_condition(springs(closed));
}

std::vector<spring_at> factored_stiffness::springs(std::span<const char> closed) const {
  std::vector<spring_at> list;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const int dof = structure_.dof_of_pair(static_cast<int>(i));
    if (closed[i] != 0 && structure_.fixed[static_cast<std::size_t>(dof)] == 0)
      list.push_back({structure_.row_of(dof), structure_.pairs[i].stiffness});
  }
  return list;
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
