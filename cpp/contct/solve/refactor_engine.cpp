#include "contct/solve/refactor_engine.hpp"

namespace contct::solve {

refactor_engine::refactor_engine(const linear_structure& s)
    : spring_engine(s), stiffness_(s), w_star_(s.dofs()) {}

/// For the one solve that follows.
void refactor_engine::factor() {
  stiffness_.factor(apply_all());
  ++counts_.factors;
  ++counts_.solves;
}

void refactor_engine::respond(const residual_load& residual, std::span<double> d_star) {
  factor();
  for (std::size_t i = 0; i < w_star_.size(); ++i) w_star_[i] = residual.share * residual.increment[i];
  stiffness_.solve(w_star_);
  gather_at_pairs(structure_, w_star_, d_star);
}

void refactor_engine::recover(std::span<const double> load, std::span<const double> pair_forces,
                              std::span<double> u) {
  factor();
  stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
}

double refactor_engine::reciprocal_condition() {
  return stiffness_.reciprocal_condition(wanted_);
}

}  // namespace contct::solve
