#include "contct/solve/refactor_engine.hpp"

#include <algorithm>

namespace contct {

refactor_engine::refactor_engine(const linear_structure& s)
    : structure_(s), closed_(s.pairs.size()), stiffness_(s), w_star_(static_cast<std::size_t>(s.dofs())) {
  for (std::size_t i = 0; i < s.pairs.size(); ++i) closed_[i] = s.pairs[i].closed ? 1 : 0;
}

void refactor_engine::switch_spring(int pair, bool closed) {
  closed_[static_cast<std::size_t>(pair)] = closed ? 1 : 0;
}

void refactor_engine::respond(const residual_load& residual, std::span<double> d_star) {
  stiffness_.factor(closed_);
  ++counts_.factors;
  ++counts_.solves;
  for (std::size_t i = 0; i < w_star_.size(); ++i) w_star_[i] = residual.share * residual.increment[i];
  stiffness_.solve(w_star_);
  for (std::size_t i = 0; i < d_star.size(); ++i)
    d_star[i] = w_star_[static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)))];
}

void refactor_engine::recover(std::span<const double> load, std::span<const double> pair_forces,
                              std::span<double> u) {
  stiffness_.factor(closed_);
  ++counts_.factors;
  ++counts_.solves;
  stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
}

double refactor_engine::reciprocal_condition() {
  return stiffness_.reciprocal_condition(closed_);
}

}  // namespace contct
