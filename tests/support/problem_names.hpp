// Names of face layouts and verdicts, for messages.
#pragma once

#include <string_view>

#include "contct/lab/random_problem.hpp"

namespace contct::app {

inline std::string_view name_of(face_layout f) {
  constexpr std::string_view names[] = {"gaps",      "zero gaps", "mixed",         "equal gaps",
                                        "near ties", "symmetric", "antisymmetric", "two-sided"};
  return names[static_cast<int>(f)];
}

inline constexpr int verdicts = 5;

inline std::string_view name_of(verdict v) {
  constexpr std::string_view names[] = {"certified", "no equilibrium", "wrong", "false mechanism", "no end"};
  return names[static_cast<int>(v)];
}

}  // namespace contct::app
