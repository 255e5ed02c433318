// The certified state of a problem's end, and how another answer compares with it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench/peers/exchange.hpp"

namespace bench::peers {

/// Where CalculiX has a row of K; node 0: nowhere.
struct place {
  int node = 0, direction = 0;
};

/// Kinds of numbers: each is measured by the largest of its own.
enum kind { deflection, other_displacement, force, kinds };

struct certified_state {
  std::array<double, kinds> bounds{};  ///< proved: no number of a kind is further from the truth
  std::vector<double> u;               ///< [rows]
  std::vector<char> deflects;          ///< [rows]
  std::vector<place> places;           ///< [rows]
  std::vector<double> forces;          ///< [springs] positive where it presses, otherwise 0
};

void write_state(const std::string& folder, const certified_state& s);
[[nodiscard]] certified_state read_state(const std::string& folder);

struct verdict {
  double digits = 0.0;  ///< that all numbers are proved to have, at most 15
  int statuses = 0;     ///< of pairs that are wrong
  int values = 0;       ///< compared
};

/// Judge an answer. Its distance from the state, and the bound on the state's own distance from the truth,
/// are taken together: no answer gets more digits than are proved.
[[nodiscard]] verdict judge(const certified_state& s, const answer& a);

}  // namespace bench::peers
