// Another program's way to the end of a step, on the benchmark's problems: CHOLMOD by itself.
#pragma once

#include <string>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/model/structure.hpp"

namespace bench {

/// What it found, against our certified state.
struct peer_answer {
  std::string method;
  double seconds = 0.0;    ///< of processor time, from K in memory to D; the median
  int steps = 0;           ///< of Newton's method
  double digits = 0.0;     ///< that all numbers are proved to have, at most 15
  int wrong_statuses = 0;  ///< of pairs
  int values = 0;          ///< compared
};

/// For a problem of one load step without settlements: Newton's method on K and the springs that press, a
/// factor updated by those that change, and a factor anew for each step. Nothing where CHOLMOD was not found.
/// Throws std::runtime_error where our own end is not certified.
[[nodiscard]] std::vector<peer_answer> time_cholmod(const contct::problem& p,
                                                    const contct::linear_structure& s, int rounds);

}  // namespace bench
