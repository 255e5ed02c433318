#include "contct/certify/final_state.hpp"

#include <algorithm>

#include "contct/certify/reference_solution.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace contct::certify {
namespace {

using outcome = reference_answer::outcome;

/// The pressed pairs, and where these and the supports leave a motion free, open ones that would stop it: at
/// rest, their springs take no force.
std::vector<char> holding(const linear_structure& s, std::vector<char> pressed) {
  rigid_rank rank = s.nothing_held();
  for (const rigid_row& row : s.held_by_supports) rank.hold(row);
  for (std::size_t i = 0; i < pressed.size(); ++i)
    if (pressed[i] != 0) rank.hold(s.held_by_pairs[i]);
  for (std::size_t i = 0; i < pressed.size() && rank.rank() < s.rigid_motions; ++i) {
    const int before = rank.rank();
    rank.hold(s.held_by_pairs[i]);
    if (rank.rank() > before) pressed[i] = 1;
  }
  return pressed;
}

}  // namespace

fallback_solver fallback_to_reference(const linear_structure& s) {
  return [&s](std::span<const double> load) -> std::optional<equilibrium_state> {
    reference_answer answer = reference_solver(s).solve(load);
    if (answer.how != outcome::found) return {};
    return equilibrium_state{std::move(answer.displacement), std::move(answer.pressed)};
  };
}

path_end find_final_states(const linear_structure& s, int steps, const load_history& total_load,
                           std::span<observer* const> observers) {
  reference_solver finds(s);
  factored_stiffness stiffness(s);
  std::vector<double> total(s.dofs());
  path_end end;
  for (int step = 1; step <= steps; ++step) {
    std::fill(total.begin(), total.end(), 0.0);
    total_load(step, total);
    const reference_answer found = finds.solve(total);
    end.work.factors += found.factorisations;
    if (found.how == outcome::no_equilibrium) return {path_status::mechanism, step, 0.0, {}, end.work};
    if (found.how != outcome::found) return {path_status::not_factored, step, 0.0, {}, end.work};
    std::vector<int> status;
    for (const char pressed : found.pressed) status.push_back(pressed != 0 ? in_contact : separated);
    const double rcond = stiffness.reciprocal_condition(holding(s, found.pressed));
    ++end.work.factors;
    for (observer* o : observers)
      o->step_ended({.step = step,
                     .fraction = 1.0,
                     .displacement = found.displacement,
                     .isep = status,
                     .rcond = rcond,
                     .from_fallback = false,
                     .from_reference = true});
    end.step = step;
  }
  return end;
}

}  // namespace contct::certify
