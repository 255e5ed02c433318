// Correct problem files, and their changed forms.
#pragma once

#include <string>

namespace contct {

/// A correct problem on a beam. The numbers of its lines are on the right.
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

/// A correct problem on a plate.
inline const char* const good_plate =
    "[plate]\n"                                                                  // 1
    "x = [0.0, 0.5, 1.0]\n"                                                      // 2
    "y = [0.0, 1.0]\n"                                                           // 3
    "E = 10.92\n"                                                                // 4
    "nu = 0.3\n"                                                                 // 5
    "thickness = 1.0\n"                                                          // 6
    "[[support]]\n"                                                              // 7
    "nodes = [1, 4]\n"                                                           // 8
    "fix = [\"w\", \"wx\", \"wy\"]\n"                                            // 9
    "[[contact]]\n"                                                              // 10
    "node = 6\n"                                                                 // 11
    "surface = \"below\"\n"                                                      // 12
    "face = -0.01\n"                                                             // 13
    "stiffness = 5.0e2\n"                                                        // 14
    "[[step]]\n"                                                                 // 15
    "uniform = [ { value = -1.0 }, { value = -2.0, elements = \"2..2\" } ]\n"    // 16
    "point = [ { node = 3, w = -1.0, wx = 0.25 }, { node = 6, wy = -0.5 } ]\n";  // 17

/// Return `good_problem` and `good_plate` with `piece` replaced by `mistake`.
inline std::string with(const std::string& piece, const std::string& mistake) {
  std::string text = good_problem;
  return text.replace(text.find(piece), piece.size(), mistake);
}
inline std::string plate_with(const std::string& piece, const std::string& mistake) {
  std::string text = good_plate;
  return text.replace(text.find(piece), piece.size(), mistake);
}

}  // namespace contct
