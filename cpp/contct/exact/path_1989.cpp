// The listing's statements in exact arithmetic.
#include <utility>

#include "contct/exact/position.hpp"

namespace contct::exact {
namespace {

// The constants as they are printed: 1.E-20, 1.E-10 and .390625E-02.
const rational& delta() {
  static const rational value(integer(1), boost::multiprecision::pow(integer(10), 20U));
  return value;
}
const rational& epsgap() {
  static const rational value(integer(1), boost::multiprecision::pow(integer(10), 10U));
  return value;
}
const rational& epsmul() {
  static const rational value(1, 256);
  return value;
}

/// DO 10: s of one pair, whose d* is `d_star`.
rational scale_factor(const position& at, std::size_t pair, const rational& d_star) {
  const exact_pair& c = at.problem.pairs[pair];
  const rational gap = c.face - at.u[static_cast<std::size_t>(c.dof)];
  if (d_star == 0) return 1;
  if (abs(gap) < epsgap()) {
    const rational s_chk = (at.closed[pair] != 0 ? -c.surface : c.surface) / d_star;
    return s_chk > 0 ? rational(s_chk * delta()) : rational(1);
  }
  return gap / d_star;
}

/// One call of CONTCT: toggles statuses, and returns SMIN.
rational ask(position& at, const vector& d_star) {
  vector s;
  rational s_min = 1;
  for (std::size_t i = 0; i < at.closed.size(); ++i) {
    s.push_back(scale_factor(at, i, d_star[static_cast<std::size_t>(at.problem.pairs[i].dof)]));
    if (s[i] > 0 && s[i] < s_min) s_min = s[i];
  }
  if (s_min == 1) return s_min;
  for (std::size_t i = 0; i < s.size(); ++i)  // DO 30
    if (abs(s[i] - s_min) / s_min < epsmul()) at.closed[i] = at.closed[i] != 0 ? 0 : 1;
  return s_min;
}

/// One step of the 1989 driver.
path_status follow_step(position& at, std::vector<exact_increment>& increments, const exact_progress& tell) {
  while (increments.size() < most_exact_increments(at.problem)) {
    if (tell) tell(static_cast<int>(at.step) + 1, static_cast<int>(increments.size()) + 1, at.fraction);
    at.factor();
    if (!at.solver().free_motions().empty()) return path_status::mechanism;
    vector d_star = at.response();
    for (rational& d : d_star) d *= 1 - at.fraction;  // under the residual load
    const std::vector<char> before = at.closed;
    const rational s_min = ask(at, d_star);
    for (std::size_t dof = 0; dof < d_star.size(); ++dof) at.u[dof] += s_min * d_star[dof];
    at.fraction += s_min * (1 - at.fraction);
    if (bits_of(at.fraction) > lifted_solver::most_bits)
      throw too_long("the share of the load has more than " + std::to_string(lifted_solver::most_bits) +
                     " bits");
    increments.push_back({at.fraction, at.events_since(before)});
    if (s_min == 1) return path_status::solved;
  }
  return path_status::iteration_limit;
}

}  // namespace

exact_path follow_1989_path(const exact_problem& p, const exact_progress& tell) {
  exact_path path;
  position at(p);
  for (std::size_t step = 0; step < p.steps.size() && path.status == path_status::solved; ++step) {
    at.begin_step(step);
    std::vector<exact_increment> increments;
    path.status = follow_step(at, increments, tell);
    path.steps.push_back(at.end(std::move(increments), false));
  }
  return path;
}

}  // namespace contct::exact
