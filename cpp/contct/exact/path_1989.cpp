#include "contct/exact/path_1989.hpp"

#include <utility>

namespace contct::exact {

/// False where there is no further one.
bool path_1989::begin_increment() {
  if (status_ != path_status::solved) return false;
  const auto begun = static_cast<std::size_t>(call_.step);
  if (begun == 0 || ended_step()) {
    if (begun == at_.problem.steps.size()) return false;
    at_.begin_step(begun);
    call_.step += 1;
    call_.increment = 0;
  } else if (static_cast<std::size_t>(call_.increment) == most_exact_increments(at_.problem)) {
    status_ = path_status::iteration_limit;
    return false;
  }
  call_.increment += 1;
  return true;
}

/// One call of CONTCT: toggles statuses.
void path_1989::ask(const vector& d_star) {
  std::vector<listing_pair> pairs;
  for (std::size_t i = 0; i < at_.closed.size(); ++i) {
    const exact_pair& c = at_.problem.pairs[i];
    const auto dof = static_cast<std::size_t>(c.dof);
    pairs.push_back({c.face, at_.u[dof], d_star[dof], at_.closed[i] != 0, c.surface});
  }
  call_.answer = answer_exactly(pairs);
  for (const int pair : call_.answer.toggled) {
    char& closed = at_.closed[static_cast<std::size_t>(pair)];
    closed = closed != 0 ? 0 : 1;
  }
}

bool path_1989::next(const exact_progress& tell) {
  if (!begin_increment()) return false;
  if (tell) tell(call_.step, call_.increment, at_.fraction);
  at_.factor();
  if (!at_.solver().free_motions().empty()) {
    status_ = path_status::mechanism;
    return false;
  }
  vector d_star = at_.response();
  for (rational& d : d_star) d *= 1 - at_.fraction;  // under the residual load
  const std::vector<char> before = at_.closed;
  ask(d_star);
  const rational& s_min = call_.answer.s_min;
  for (std::size_t dof = 0; dof < d_star.size(); ++dof) at_.u[dof] += s_min * d_star[dof];
  at_.fraction += s_min * (1 - at_.fraction);
  if (length_in_bits(at_.fraction) > lifted_solver::most_bits)
    throw too_long("the share of the load has more than " + std::to_string(lifted_solver::most_bits) +
                   " bits");
  call_.led_to = {at_.fraction, at_.events_since(before)};
  return true;
}

exact_path follow_1989_path(const exact_problem& p, const exact_progress& tell) {
  exact_path path;
  path_1989 walk(p);
  std::vector<exact_increment> increments;
  while (walk.next(tell)) {
    increments.push_back(walk.call().led_to);
    if (walk.ended_step()) path.steps.push_back(walk.state(std::exchange(increments, {})));
  }
  path.status = walk.status();
  if (path.status != path_status::solved) path.steps.push_back(walk.state(std::move(increments)));
  return path;
}

}  // namespace contct::exact
