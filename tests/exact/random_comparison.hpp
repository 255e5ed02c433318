// The corrected rule and its certificate beside the exact path, on random problems, counted by kind.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "contct/certify/certificate.hpp"
#include "contct/exact/kernel_digits.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "exact/equilibrium.hpp"

namespace contct::exact {

struct comparison_counts {
  int problems = 0;          ///< followed exactly
  int steps = 0;             ///< whose ends were compared
  int mechanisms = 0;        ///< of both paths
  int not_equilibrium = 0;   ///< exact ends that are none
  int false_mechanism = 0;   ///< the kernel finds none where there is an equilibrium
  int false_solution = 0;    ///< the kernel solves what has no equilibrium
  int beyond_tolerance = 0;  ///< certified, and a displacement is further off than its certificate allows
  int other_events = 0;
  double fewest_digits = 16.0;  ///< of a certified path
};

using difference_sink = std::function<void(std::uint64_t number, const std::string& words)>;

/// Follow one problem both ways and add what came of it.
inline void compare_one(std::uint64_t number, const lab::random_problem& drawn, comparison_counts& counts,
                        const difference_sink& tell) {
  const structure::problem& p = drawn;
  const exact_problem e = exact_problem_of(p);
  const exact_path exactly = follow_true_path(e);
  for (std::size_t step = 0; step < exactly.steps.size(); ++step) {
    if (exactly.steps[step].fraction != 1) continue;
    const std::string wrong = wrong_with(e, e.steps[step], exactly.steps[step]);
    if (wrong.empty()) continue;
    ++counts.not_equilibrium;
    tell(number, "the exact end is no equilibrium: " + wrong);
  }
  const structure::linear_structure s = structure_of(p);
  const auto leader = outside::make_kernel("corrected");
  digit_counter counter(p, exactly);
  certify::certifier judged(p, s);
  const path::path_end end = path::follow(p, s, "refactor", *leader, {&judged, &counter}, {0, judged.ends()});
  const kernel_digits r = counter.result("corrected", end.status, 1e-9);
  ++counts.problems;
  counts.steps += static_cast<int>(judged.steps().size());
  if (end.status != exactly.status) {
    const bool solved = end.status == path_status::solved;
    ++(solved ? counts.false_solution : counts.false_mechanism);
    tell(number, solved ? "solved where there is no equilibrium" : "no equilibrium found where there is one");
    return;
  }
  counts.mechanisms += end.status == path_status::mechanism ? 1 : 0;
  if (!r.same_events) {
    ++counts.other_events;
    tell(number, "events: " + r.first_difference);
  }
  constexpr double allowed = certify::certified_share;
  bool unique = true;
  for (const auto& c : judged.steps()) {
    if (!c || !c->certified) return;
    unique = unique && c->unique;
  }
  if (!unique) return;
  counts.fewest_digits = std::min(counts.fewest_digits, r.digits);
  if (std::pow(10.0, -r.digits) > allowed) {
    ++counts.beyond_tolerance;
    tell(number,
         "certified to " + std::to_string(allowed) + " and " + std::to_string(r.digits) + " digits right");
  }
}

}  // namespace contct::exact
