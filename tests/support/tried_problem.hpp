// Solves a random problem, and counts the events of its path.
#pragma once

#include <algorithm>
#include <string_view>

#include "contct/results/random_problem.hpp"

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
  int at_rest = 0;  ///< increments without progress
  int snaps = 0;    ///< rigid-body motions at constant load

  void incremented(const increment& i) override {
    at_rest += i.s == 0.0 ? 1 : 0;
    snaps += i.snaps ? 1 : 0;
    for (const event& e : i.events) ++(e.what == change::make ? makes : breaks);
  }
};

/// Returns the largest error measure in any certificate.
inline double needed_by(const problem_result& t) {
  double needed = 0.0;
  for (const solved_step& s : t.followed.steps)
    if (s.judged)
      needed = std::max({needed, s.judged->worst_share, s.judged->penetration, s.judged->tension});
  return needed;
}

}  // namespace contct
