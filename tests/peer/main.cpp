// CalculiX as a peer: another program, by other elements and another way of solving, comes to the same
// states. Usage: contct_peer CONTCT CCX REFERENCE FOLDER
#include <fmt/format.h>

#include <exception>

#include "peer/programs.hpp"

int main(int argc, char** argv) {
  using namespace contct::app::peer;
  if (argc != 5) {
    fmt::print(stderr, "usage: contct_peer CONTCT CCX REFERENCE FOLDER\n");
    return 2;
  }
  const places p = {argv[1], argv[2], argv[3], argv[4]};
  verdicts v;
  for (const auto checks : {check_structures, check_solids}) {
    try {
      checks(p, v);
    } catch (const std::exception& e) {
      v.check(false, e.what());
    }
  }
  constexpr int fewest = 54;
  if (v.checks() < fewest)
    v.check(false, fmt::format("only {} checks were made; at least {} are there", v.checks(), fewest));
  fmt::print("CalculiX as a peer: {} checks, {} failed\n", v.checks(), v.failures());
  return v.failures() == 0 ? 0 : 1;
}
