// Solves a random problem, and counts the events of its path.
#pragma once

#include <algorithm>
#include <limits>
#include <string_view>

#include "contct/lab/random_problem.hpp"

namespace contct {

inline std::string_view name_of(face_layout f) {
  constexpr std::string_view names[] = {"gaps",      "zero gaps", "mixed",         "equal gaps",
                                        "near ties", "symmetric", "antisymmetric", "two-sided"};
  return names[static_cast<int>(f)];
}

inline std::string_view name_of(verdict v) {
  constexpr std::string_view names[] = {"certified", "no equilibrium", "wrong", "false mechanism", "no end"};
  return names[static_cast<int>(v)];
}

/// Counts of the events on a path.
struct path_counts final : observer {
  int makes = 0, breaks = 0;
  int at_rest = 0;    ///< increments without progress
  int snaps = 0;      ///< rigid-body motions at constant load
  int fallbacks = 0;  ///< steps that ended in the reference solution

  void incremented(const increment& i) override {
    at_rest += i.s == 0.0 ? 1 : 0;
    snaps += i.snaps ? 1 : 0;
    for (const event& e : i.events) ++(e.what == change::make ? makes : breaks);
  }
  void step_ended(const step_state& s) override { fallbacks += s.from_reference ? 1 : 0; }
};

/// Returns the largest error measure in any certificate.
inline double needed_by(const problem_result& t) {
  double needed = 0.0;
  for (const certificate& c : t.certificates)
    needed = std::max({needed, c.displacement_error, c.shape_error, c.equilibrium, c.penetration, c.tension});
  return needed;
}

/// Solves p with its own structure, and counts the events of its path.
inline problem_result try_and_count(const random_problem& p, kernel& leader, path_counts& counts) {
  return try_structure(p, build(p.geometry, p.supports, p.pairs), leader, "refactor", {&counts});
}

}  // namespace contct
