#include "contct/lab/problem_result.hpp"

#include <algorithm>
#include <limits>

#include "contct/certify/certificate.hpp"
#include "contct/certify/fallback.hpp"
#include "contct/path/path.hpp"

namespace contct {
namespace {

/// Counts what happens on a path.
class counter final : public observer {
 public:
  explicit counter(problem_result& t) : t_(t) {}

  void incremented(const increment& i) override {
    ++t_.increments;
    t_.at_rest += i.s == 0.0 ? 1 : 0;
    t_.snaps += i.snaps ? 1 : 0;
    for (const event& e : i.events) ++(e.what == change::make ? t_.makes : t_.breaks);
  }
  void step_ended(const step_state& s) override { t_.fallbacks += s.from_fallback ? 1 : 0; }

 private:
  problem_result& t_;
};

void take_in(const certificate& c, problem_result& t) {
  const double needed =
      std::max({c.displacement_error, c.shape_error, c.equilibrium, c.penetration, c.tension});
  t.displacement_error = std::max(t.displacement_error, c.displacement_error);
  t.length_error = std::max({t.length_error, c.displacement_error, c.penetration, c.tension});
  t.needed = std::max(t.needed, needed);
  t.factor = std::max(t.factor, needed / (std::numeric_limits<double>::epsilon() / c.rcond));
  ++t.steps;
  t.uncertified += c.exact ? 0 : 1;
  t.unfounded += c.unfounded ? 1 : 0;
}

verdict judge(const path_end& end, const certifier& judged, const load_history& total,
              const linear_structure& s) {
  if (end.status == path_status::solved) return judged.all_exact() ? verdict::certified : verdict::wrong;
  if (end.status != path_status::mechanism) return verdict::no_end;
  std::vector<double> load(static_cast<std::size_t>(s.dofs()), 0.0);
  total(end.step, load);
  const bool agreed = oracle(s).solve(load).how == oracle_answer::outcome::no_equilibrium;
  return agreed ? verdict::no_equilibrium : verdict::false_mechanism;
}

}  // namespace

std::string_view name_of(verdict v) {
  constexpr std::string_view names[] = {"certified", "no equilibrium", "wrong", "false mechanism", "no end"};
  return names[static_cast<int>(v)];
}

problem_result try_problem(const random_problem& p, kernel& leader, std::string_view engine) {
  return try_structure(p, build(p.geometry, p.supports, p.pairs), leader, engine);
}

problem_result try_structure(const random_problem& p, const linear_structure& s, kernel& leader,
                             std::string_view engine) {
  const load_history total = [&p](int step, std::span<double> f) {
    add_consistent_loads(p.geometry, p.steps[static_cast<std::size_t>(step - 1)], f);
  };
  problem_result t;
  counter counts(t);
  certifier judged(s, total);
  observer* const observers[] = {&counts, &judged};
  const std::unique_ptr<stiffness_engine> solves = make_engine(engine, s);
  path_limits limits;
  limits.fallback = fallback_to_reference(s);
  const path_end end =
      follow_path(s, static_cast<int>(p.steps.size()), total, *solves, leader, observers, limits);
  for (const auto& c : judged.steps()) {
    if (c) take_in(*c, t);
  }
  t.came_to = judge(end, judged, total, s);
  return t;
}

}  // namespace contct
