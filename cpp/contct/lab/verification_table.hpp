// The numbers that the problems in reference/ are checked against.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::lab {

/// One number of reference/verification.toml, whose head explains the fields. Nodes, elements and
/// pairs count from 1, as in the file; 0 where a quantity does not need them.
struct expected_number {
  int step = 0;
  std::string quantity;
  int node = 0, pair = 0, element = 0;
  int place = 0;  ///< in the element: its end, 1 the left one, or its corner
  std::string dof, change, along;
  double from = 0.0;
  double value = 0.0;  ///< of a state: -1 in contact, +1 separated
  std::string kind, because, source;
  double tolerance = 0.0;          ///< relative; absolute for a value of 0
  std::optional<double> faithful;  ///< what the 1989 rule gives instead
  std::string reason;              ///< why it does
};

/// One problem file and its numbers.
struct verification_case {
  std::string file;  ///< as written, relative to reference/problems
  std::vector<expected_number> checks;
};

/// Read the table. Throws input_error.
[[nodiscard]] std::vector<verification_case> read_verification(const std::string& path);

/// What a number is, in a few words: "w, node 3", "pair 2 makes" (the share of the load at which it
/// does), "moment, element 4.1" (at its first end or corner).
[[nodiscard]] std::string quantity_words(const expected_number& e);

}  // namespace contct::lab
