#include "contct/path/solve_problem.hpp"

namespace contct::path {

linear_structure structure_of(const problem& p) {
  return build(p.geometry, p.supports, p.pairs);
}

load_history loads_of(const problem& p) {
  return [&p](int step, std::span<double> f) { add_consistent_loads(p.geometry, p.steps[step - 1], f); };
}

path_end follow(const problem& p, const linear_structure& s, std::string_view engine, kernel& leader,
                const std::vector<observer*>& observers, const path_limits& limits) {
  return follow_steps(p.geometry, s, p.steps, engine, leader, observers, limits);
}

}  // namespace contct::path
