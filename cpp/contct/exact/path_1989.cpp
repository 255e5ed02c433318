
#include <string>
#include <utility>

#include "contct/exact/position.hpp"

namespace contct {
namespace {

// DELTA, EPSGAP and EPSMUL as printed: 1.E-20, 1.E-10 and .390625E-02 = 1/256.
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

/// The scale factor s of one pair (DO 10).
rational scale_factor(const listing_pair& p) {
  const rational gap = p.c - p.d;
  if (p.d_star == 0) return 1;
  if (abs(gap) >= epsgap()) return gap / p.d_star;
  const rational s_chk = p.isep * p.surface / p.d_star;
  return s_chk > 0 ? rational(s_chk * delta()) : 1;
}

class path_1989 final : public exact_rule {
 public:
  path_1989(const exact_problem& p, const exact_progress& tell) : exact_rule(p, tell, false) {}

 private:
  path_status follow_step() override;
  exact_increment next();

  rational s_min_ = 1;  // SMIN of the last call; 1: the call ended a step
};

/// Calls CONTCT once and applies its answer.
exact_increment path_1989::next() {
  rational_vector d_star = at_.response();
  for (rational& d : d_star) d *= 1 - at_.fraction;  // the response to the rest of the load
  const std::vector<int> before = at_.isep;
  std::vector<listing_pair> pairs;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const exact_pair& c = at_.problem.pairs[i];
    pairs.push_back({c.face, c.seen_in(at_.u), c.seen_in(d_star), before[i], c.surface});
  }
  const listing_answer answer = answer_exactly(pairs);
  s_min_ = answer.s_min;
  for (const int pair : answer.toggled) at_.isep[pair] *= -1;
  for (std::size_t dof = 0; dof < d_star.size(); ++dof) at_.u[dof] += s_min_ * d_star[dof];
  at_.fraction += s_min_ * (1 - at_.fraction);
  if (length_in_bits(at_.fraction) > lifted_solver::most_bits)
    throw too_long("the share of the load has more than " + std::to_string(lifted_solver::most_bits) +
                   " bits");
  return {at_.fraction, at_.events_since(before)};
}

path_status path_1989::follow_step() {
  for (std::size_t number = 1; begin_increment(number); ++number) {
    at_.factor();
    if (!at_.solver().free_motions().empty()) return path_status::mechanism;
    increments_.push_back(next());
    if (s_min_ == 1) return path_status::solved;
  }
  return path_status::iteration_limit;
}

}  // namespace

listing_answer answer_exactly(std::span<const listing_pair> pairs) {
  listing_answer a;
  for (const listing_pair& p : pairs) {
    rational s = scale_factor(p);
    if (s > 0 && s < a.s_min) a.s_min = s;
    a.s.push_back(std::move(s));
  }
  if (a.s_min == 1) return a;
  for (std::size_t i = 0; i < a.s.size(); ++i)  // DO 30
    if (abs(a.s[i] - a.s_min) / a.s_min < epsmul()) a.toggled.push_back(static_cast<int>(i));
  return a;
}

exact_path follow_1989_path(const exact_problem& p, const exact_progress& tell) {
  return path_1989(p, tell).follow();
}

}  // namespace contct
