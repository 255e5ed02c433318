#include "contct/structure/stiffness_factor.hpp"

#include <stdexcept>

#include "contct/structure/cholesky.hpp"

namespace contct {

stiffness_factor::stiffness_factor(const stiffness_matrix& k) : k_(k) {}

bool stiffness_factor::factor(std::span<const spring_at> springs) {
  if (k_.is_band()) {
    assemble(springs);
    return contct::factor(band_);
  }
  if (!sparse_) sparse_.emplace(k_.columns());
  return sparse_->factor(diagonal_with(springs));
}

void stiffness_factor::solve(std::span<double> b) {
  if (sparse_) {
    sparse_->solve(b);
  } else {
    solve_with(band_, b);
  }
}

double stiffness_factor::reciprocal_condition(std::span<const spring_at> springs) {
  if (k_.is_band()) {
    assemble(springs);
    return contct::reciprocal_condition(band_);
  }
  if (!factor(springs)) return 0.0;
  return contct::reciprocal_condition(k_, diagonal_with(springs), [this](std::span<double> b) { solve(b); });
}

const band_matrix& stiffness_factor::band() const {
  if (!k_.is_band()) throw std::logic_error("a sparse stiffness has no band");
  return band_;
}

/// In place where the last factor stood.
void stiffness_factor::assemble(std::span<const spring_at> springs) {
  band_ = k_.band();
  for (const spring_at& s : springs) band_.at(s.row, s.row) += s.stiffness;
}

std::vector<double> stiffness_factor::diagonal_with(std::span<const spring_at> springs) const {
  std::vector<double> diagonal(static_cast<std::size_t>(k_.order()));
  for (int row = 0; row < k_.order(); ++row) diagonal[static_cast<std::size_t>(row)] = k_.diagonal(row);
  for (const spring_at& s : springs) diagonal[static_cast<std::size_t>(s.row)] += s.stiffness;
  return diagonal;
}

}  // namespace contct
