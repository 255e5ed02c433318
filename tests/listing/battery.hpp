// The battery: hand-chosen calls of CONTCT that every copy of the listing has to answer.
#pragma once

#include <string>
#include <vector>

namespace contct_test {

/// One pair as a call sees it. Two pairs at one node must agree in d and d_star.
struct battery_pair {
  int node;       ///< ID
  double d;       ///< DD at the pair's dof
  double d_star;  ///< DTEST at the pair's dof
  double c;       ///< CC
  int isep;       ///< ISEP on entry
  int isurf;      ///< ISURF
};

struct battery_call {
  std::string name;
  std::vector<battery_pair> pairs;
  int indof = 1;
  int ndofpn = 1;
};

/// The first call has a single pair at node 1: the one call that `DIMENSION X(1)` allows.
std::vector<battery_call> battery();

}  // namespace contct_test
