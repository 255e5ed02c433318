// Lists kinds of bad input that only a plate can have.
#pragma once

#include <string>
#include <vector>

#include "read/refusals.hpp"

namespace contct {

/// A correct plate, in which each mistake replaces one piece. The numbers of its lines are on the right.
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

/// Returns `good_plate` with `piece` replaced by `mistake`.
inline std::string plate_with(const std::string& piece, const std::string& mistake) {
  std::string text = good_plate;
  return text.replace(text.find(piece), piece.size(), mistake);
}

/// Returns `good_plate` with these lines instead of its lists x and y, for even grids.
inline std::string even_plate_with(const std::string& lines) {
  return plate_with("x = [0.0, 0.5, 1.0]\ny = [0.0, 1.0]\n", lines);
}

inline std::vector<bad_input> bad_plates() {
  const std::string uniform = "uniform = [ { value = -1.0 }, { value = -2.0, elements = \"2..2\" } ]";
  return {
      {"a beam and a plate", plate_with("[plate]", "beam = { length = 1, elements = 1, EI = 1 }\n[plate]"),
       "2:1", "plate", "this key together with beam", "exactly one"},
      {"plate in double brackets", plate_with("[plate]", "[[plate]]"), "1:1", "plate", "an array of 1",
       "[plate] in single brackets"},
      {"an unknown key", plate_with("thickness", "thick"), "6:1", "plate.thick", "unknown", "thickness"},
      {"a beam's EI", plate_with("E = 10.92", "EI = 10.92"), "4:1", "plate.EI", "unknown", "E, nu"},
      {"a beam's length", even_plate_with("length = 1.0\nelements = [2, 1]\n"), "2:1", "plate.length",
       "unknown", "size"},
      {"x without y", plate_with("y = [0.0, 1.0]\n", ""), "1:1", "plate.y", "missing", "at least 2"},
      {"one grid line only", plate_with("y = [0.0, 1.0]", "y = [0.0]"), "3:5", "plate.y", "array of 1",
       "at least 2"},
      {"unordered grid lines", plate_with("0.5, 1.0]", "1.5, 1.0]"), "2:16", "plate.x[3]", "1",
       "more than the line before it, 1.5"},
      {"x is one number", plate_with("x = [0.0, 0.5, 1.0]", "x = 1.0"), "2:5", "plate.x", "1", "an array"},
      {"size beside x and y", plate_with("E = ", "size = [1, 1]\nE = "), "4:8", "plate.size",
       "this key together with x or y", "either x and y, or size and elements"},
      {"neither grid nor size", even_plate_with(""), "1:1", "plate.size", "missing", "greater than 0"},
      {"a size of one number", even_plate_with("size = 1.0\nelements = [2, 1]\n"), "2:8", "plate.size", "1",
       "an array"},
      {"a size of three numbers", even_plate_with("size = [1, 1, 1]\nelements = [2, 1]\n"), "2:8",
       "plate.size", "array of 3", "two numbers"},
      {"size without elements", even_plate_with("size = [1, 1]\n"), "1:1", "plate.elements", "missing",
       "two whole numbers"},
      {"elements as one number", even_plate_with("size = [1, 1]\nelements = 2\n"), "3:12", "plate.elements",
       "2", "two whole numbers"},
      {"no elements along y", even_plate_with("size = [1, 1]\nelements = [2, 0]\n"), "3:16",
       "plate.elements[2]", "0", "from 1"},
      {"more elements along x than anyone has memory for",
       even_plate_with("size = [1, 1]\nelements = [4000000000, 1]\n"), "3:13", "plate.elements[1]",
       "4000000000", "to 2000000"},
      {"more elements in all than are allowed", even_plate_with("size = [1, 1]\nelements = [2000000, 2]\n"),
       "1:1", "plate", "2000000 x 2 elements", "at most 2000000"},
      {"a stiffness matrix that no machine holds",
       even_plate_with("size = [1, 1]\nelements = [1000, 1000]\n"), "1:1", "plate",
       "1000 x 1000 elements, whose stiffness matrix takes 72", "at most 4.0 GB"},
      {"no nu", plate_with("nu = 0.3\n", ""), "1:1", "plate.nu", "missing", "at most 0.5"},
      {"nu above a half", plate_with("0.3", "0.51"), "5:6", "plate.nu", "0.51",
       "greater than -1 and at most 0.5"},
      {"no E and no D", plate_with("E = 10.92\n", ""), "1:1", "plate.E", "missing", "greater than 0"},
      {"a negative thickness", plate_with("thickness = 1.0", "thickness = -1.0"), "6:13", "plate.thickness",
       "-1", "greater than 0"},
      {"D beside E", plate_with("nu = 0.3", "nu = 0.3\nD = 1.0"), "4:5", "plate.E",
       "this key together with D", "either D, or E and thickness"},
      {"a negative D", plate_with("E = 10.92\nnu = 0.3\nthickness = 1.0", "D = -1.0\nnu = 0.3"), "4:5",
       "plate.D", "-1", "greater than 0"},
      {"a D beyond double precision", plate_with("thickness = 1.0", "thickness = 1e-150"), "1:1", "plate",
       "that make D = 0", "range of double precision"},
      {"a stiffness beyond double precision", plate_with("0.0, 0.5", "0.0, 1e-150"), "1:1", "plate",
       "element 1", "range of double precision"},
      {"a beam's rotation fixed", plate_with("\"wy\"]", "\"theta\"]"), "9:19", "support[1].fix[3]",
       "\"theta\"", "\"w\", \"wx\", \"wy\""},
      {"a beam's rotational spring", plate_with("fix = [\"w\", \"wx\", \"wy\"]", "spring = { theta = 1.0 }"),
       "9:12", "support[1].spring.theta", "unknown", "w, wx, wy"},
      {"a bed whose springs vanish", plate_with("[[step]]", "[[bed]]\nmodulus = 1e-320\nface = 0\n[[step]]"),
       "15:1", "bed[1]", "a stiffness of", "or area, within"},
      {"a polynomial pressure", plate_with("value = -1.0", "polynomial = [1, 2]"), "16:28",
       "step[1].uniform[1].polynomial", "an array of 2", "a polynomial is allowed only for a beam's load"},
      {"a beam's moment", plate_with("wx = 0.25", "theta = 0.25"), "17:33", "step[1].point[1].theta",
       "unknown", "at, w, wx, wy"},
      {"slopes' loads that overflow",
       plate_with("point = [ { node = 3, w = -1.0, wx = 0.25 }, { node = 6, wy = -0.5 } ]",
                  "point = [ { node = 3, wy = 1.7e308 }, { node = 6, wy = 1.7e308 } ]"),
       "15:1", "step[1]", "not finite", "range of double precision"},
      {"loads whose sum overflows",
       plate_with(uniform, "uniform = [ { value = 1e308 }, { value = 1e308, elements = [1, 2] } ]"), "15:1",
       "step[1]", "not finite", "range of double precision"},
  };
}

}  // namespace contct
