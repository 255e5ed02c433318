// A correct problem file, and its changed forms.
#pragma once

#include <string>

namespace contct {

/// A correct problem, in which each mistake replaces one piece. The numbers of its lines are on the right.
inline const char* const good_problem =
    "[beam]\n"                                // 1
    "x = [0.0, 1.0, 2.0]\n"                   // 2
    "EI = 1.0e4\n"                            // 3
    "[[support]]\n"                           // 4
    "node = 1\n"                              // 5
    "fix = [\"w\", \"theta\"]\n"              // 6
    "[[contact]]\n"                           // 7
    "node = 3\n"                              // 8
    "surface = \"below\"\n"                   // 9
    "face = -0.004\n"                         // 10
    "stiffness = 5.0e4\n"                     // 11
    "[[step]]\n"                              // 12
    "point = [ { node = 3, w = -60.0 } ]\n";  // 13

/// Returns `good_problem` with `piece` replaced by `mistake`.
inline std::string with(const std::string& piece, const std::string& mistake) {
  std::string text = good_problem;
  return text.replace(text.find(piece), piece.size(), mistake);
}

}  // namespace contct
