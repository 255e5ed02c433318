#include "contct/exact/path_1989.hpp"

#include <algorithm>
#include <stdexcept>

namespace contct {
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

/// DO 10: s of one pair, and the branch that gave it.
std::pair<rational, listing_branch> scale_factor(const listing_pair& p) {
  const rational gap = p.c - p.d;
  if (p.d_star == 0) return {1, listing_branch::no_response};
  if (abs(gap) < epsgap()) {
    const rational s_chk = (p.closed ? -p.surface : p.surface) / p.d_star;
    if (s_chk > 0) return {s_chk * delta(), listing_branch::stationary_event};
    return {1, listing_branch::stationary};
  }
  return {gap / p.d_star, listing_branch::moving};
}

}  // namespace

std::vector<int> listing_answer::winners() const {
  std::vector<int> all;
  for (std::size_t i = 0; i < s.size(); ++i)
    if (s_min != 1 && s[i] == s_min) all.push_back(static_cast<int>(i));
  return all;
}

listing_answer answer_exactly(std::span<const listing_pair> pairs) {
  listing_answer a;
  for (const listing_pair& p : pairs) {
    auto [s, way] = scale_factor(p);
    if (s > 0 && s < a.s_min) a.s_min = s;
    a.s.push_back(std::move(s));
    a.way.push_back(way);
  }
  if (a.s_min == 1) return a;
  for (std::size_t i = 0; i < a.s.size(); ++i)  // DO 30
    if (abs(a.s[i] - a.s_min) / a.s_min < epsmul()) a.toggled.push_back(static_cast<int>(i));
  return a;
}

/// False where there is no further one.
bool path_1989::begin_increment() {
  if (status_ != path_status::solved) return false;
  const std::size_t begun = call_.step;
  if (begun == 0 || ended_step()) {
    if (begun == at_.problem.steps.size()) return false;
    at_.begin_step(begun);
    call_.step += 1;
    call_.increment = 0;
  } else if (std::size_t{1} * call_.increment == most_exact_increments(at_.problem)) {
    status_ = path_status::iteration_limit;
    return false;
  }
  call_.increment += 1;
  return true;
}

/// One call of CONTCT: toggles statuses.
void path_1989::ask(const rational_vector& d_star) {
  std::vector<listing_pair> pairs;
  for (std::size_t i = 0; i < at_.closed.size(); ++i) {
    const exact_pair& c = at_.problem.pairs[i];
    pairs.push_back({c.face, at_.u[c.dof], d_star[c.dof], at_.closed[i] != 0, c.surface});
  }
  call_.answer = answer_exactly(pairs);
  for (const int pair : call_.answer.toggled) {
    char& closed = at_.closed[pair];
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
  rational_vector d_star = at_.response();
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

void exact_companion::incremented(const increment& i) {
  has_call_ = false;
  const bool is_behind_last =
      last_ && (i.step > last_->step ||
                (i.step == last_->step && last_->increment > 0 && i.number > last_->increment));
  if (parted_ || !stopped_.empty() || is_behind_last) return;
  try {
    has_call_ = path_.next();
  } catch (const std::runtime_error& e) {  // too_long is one
    stopped_ = e.what();
    return;
  }
  if (!has_call_) {
    stopped_ = path_.status() == path_status::mechanism
                   ? "it ends before: the structure has become a mechanism"
                   : "it ends before, at the limit of increments";
    parted_ = {i.step, i.number};
    return;
  }
  if (!std::ranges::equal(path_.call().led_to.events, i.events)) parted_ = {i.step, i.number};
}

}  // namespace contct
