#include "contct/lab/problem_result.hpp"

#include <algorithm>
#include <limits>

#include "contct/certify/final_state.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct::lab {
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

verdict judge(const path_end& end, const certifier& judged, const load_history& total,
              const linear_structure& s) {
  if (end.status == path_status::solved) return judged.all_exact() ? verdict::certified : verdict::wrong;
  if (end.status != path_status::mechanism) return verdict::no_end;
  std::vector<double> load(s.dofs(), 0.0);
  total(end.step, load);
  const bool agreed = reference_solver(s).solve(load).how == reference_answer::outcome::no_equilibrium;
  return agreed ? verdict::no_equilibrium : verdict::false_mechanism;
}

}  // namespace

std::string_view name_of(verdict v) {
  constexpr std::string_view names[] = {"certified", "no equilibrium", "wrong", "false mechanism", "no end"};
  return names[static_cast<int>(v)];
}

void problem_result::add(const certificate& c) {
  const double worst =
      std::max({c.displacement_error, c.shape_error, c.equilibrium, c.penetration, c.tension});
  displacement_error = std::max(displacement_error, c.displacement_error);
  length_error = std::max({length_error, c.displacement_error, c.penetration, c.tension});
  needed = std::max(needed, worst);
  factor = std::max(factor, worst / (std::numeric_limits<double>::epsilon() / c.rcond));
  ++steps;
  uncertified += c.exact ? 0 : 1;
  unfounded += c.unfounded ? 1 : 0;
}

problem_result try_problem(const random_problem& p, kernel& leader, std::string_view engine) {
  return try_structure(p, build(p.geometry, p.supports, p.pairs), leader, engine);
}

problem_result try_structure(const random_problem& p, const linear_structure& s, kernel& leader,
                             std::string_view engine) {
  const load_history total = [&p](int step, std::span<double> f) {
    add_consistent_loads(p.geometry, p.steps[step - 1], f);
  };
  problem_result t;
  counter counts(t);
  certifier judged(s, total);
  observer* const observers[] = {&counts, &judged};
  path_limits limits;
  limits.fallback = fallback_to_reference(s);
  const path_end end = follow_steps(p.geometry, s, p.steps, engine, leader, observers, limits);
  for (const auto& c : judged.steps()) {
    if (c) t.add(*c);
  }
  t.came_to = judge(end, judged, total, s);
  return t;
}

}  // namespace contct::lab
