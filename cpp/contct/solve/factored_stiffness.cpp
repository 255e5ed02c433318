#include "contct/solve/factored_stiffness.hpp"

#include "contct/matrix/band_solve.hpp"
#include "contct/solve/engine.hpp"

namespace contct::solve {

void refuse_ill_conditioned() {
  throw no_factor(
      "the structure is held, but its stiffness matrix is too ill-conditioned to be factored "
      "in double precision");
}

std::optional<stiffness_matrix> entries_of_band(const linear_structure& s) {
  if (!s.stiffness.is_band()) return {};
  return columns_of(s.stiffness.band());
}

factored_stiffness::factored_stiffness(const linear_structure& s, bool dissected)
    : structure_(s),
      entries_(dissected ? entries_of_band(s) : std::nullopt),
      factor_(entries_ ? *entries_ : s.stiffness),
      ordered_(s.rows.size()) {}

void factored_stiffness::factor(std::span<const char> closed) {
  springs_ = springs_of(structure_, closed);
  if (!factor_.factor(springs_)) refuse_ill_conditioned();
}

/// `solve` by rows what is given by dofs.
template <class Solve>
void factored_stiffness::in_order_of_rows(std::span<double> x, Solve solve) {
  const std::vector<int>& rows = structure_.rows;
  if (rows.empty()) return solve(x);
  for (std::size_t dof = 0; dof < x.size(); ++dof) ordered_[rows[dof]] = x[dof];
  solve(std::span<double>(ordered_));
  for (std::size_t dof = 0; dof < x.size(); ++dof) x[dof] = ordered_[rows[dof]];
}

void factored_stiffness::solve(std::span<double> x) {
  for (std::size_t dof = 0; dof < x.size(); ++dof)
    if (structure_.fixed[dof] != 0) x[dof] = 0.0;
  in_order_of_rows(x, [this](std::span<double> b) { factor_.solve(b); });
}

void factored_stiffness::solve_unit(int dof, std::span<double> x) {
  if (structure_.fixed[dof] != 0) return;
  x[dof] = 1.0;
  if (entries_ || !structure_.stiffness.is_band()) return solve(x);
  const int row = structure_.row_of(dof);
  in_order_of_rows(x, [this, row](std::span<double> b) { solve_from(factor_.band(), row, b); });
}

void factored_stiffness::solve_units(std::span<const int> dofs, std::vector<double>& x) {
  std::vector<int> rows;
  for (const int dof : dofs) rows.push_back(structure_.fixed[dof] != 0 ? -1 : structure_.row_of(dof));
  factor_.solve_units(rows, x);
}

void factored_stiffness::solve_refined(std::span<const double> load, std::span<double> u) {
  contct::solve::solve_refined(
      structure_, structure_.stiffness, springs_, [this](std::span<double> b) { factor_.solve(b); }, load, u);
}

double factored_stiffness::reciprocal_condition(std::span<const char> closed) {
  return factor_.reciprocal_condition(springs_of(structure_, closed));
}

}  // namespace contct::solve
