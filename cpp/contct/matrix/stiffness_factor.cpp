#include "contct/matrix/stiffness_factor.hpp"

#include <algorithm>
#include <stdexcept>

#include "contct/matrix/band_solve.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct::matrix {

stiffness_factor::stiffness_factor(const stiffness_matrix& k) : k_(k) {
  if (!k_.is_band()) sparse_ = sparse_factor::make(k_.columns());
}

bool stiffness_factor::factor(std::span<const spring_at> springs) {
  if (sparse_) return sparse_->factor(k_.diagonal_with(springs));
  assemble(springs);
  return contct::matrix::factor(band_);
}

void stiffness_factor::solve(std::span<double> b) {
  if (sparse_) return sparse_->solve(b);
  solve_with(band_, b);
}

void stiffness_factor::solve_units(std::span<const int> rows, std::vector<double>& x) {
  if (sparse_) return sparse_->solve_units(rows, x);
  x.assign(band_.order() * block_width, 0.0);
  int first = band_.order();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] < 0) continue;
    x[rows[i] * block_width + i] = 1.0;
    first = std::min(first, rows[i]);
  }
  if (first < band_.order()) solve_block_from(band_, first, x);
}

double stiffness_factor::flops() const {
  if (sparse_) return sparse_->flops();
  const double kd = k_.band().subdiagonals();
  return static_cast<double>(k_.order()) * kd * kd;
}

double stiffness_factor::reciprocal_condition(std::span<const spring_at> springs) {
  if (k_.is_band()) {
    assemble(springs);
    return contct::matrix::reciprocal_condition(band_);
  }
  if (!factor(springs)) return 0.0;
  return contct::matrix::reciprocal_condition(k_, k_.diagonal_with(springs),
                                              [this](std::span<double> b) { solve(b); });
}

const band_matrix& stiffness_factor::band() const {
  if (!k_.is_band()) throw std::logic_error("a sparse stiffness has no band");
  return band_;
}

/// Overwrites the last factor.
void stiffness_factor::assemble(std::span<const spring_at> springs) {
  band_ = k_.band();
  for (const spring_at& s : springs) band_.at(s.row, s.row) += s.stiffness;
}

}  // namespace contct::matrix
