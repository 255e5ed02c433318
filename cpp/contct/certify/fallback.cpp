#include "contct/certify/fallback.hpp"

#include "contct/certify/reference_solution.hpp"

namespace contct {

fallback_solver fallback_to_reference(const linear_structure& s) {
  return [&s](std::span<const double> load) -> std::optional<equilibrium_state> {
    oracle_answer answer = oracle(s).solve(load);
    if (answer.how != oracle_answer::outcome::found) return {};
    return equilibrium_state{std::move(answer.displacement), std::move(answer.pressed)};
  };
}

}  // namespace contct
