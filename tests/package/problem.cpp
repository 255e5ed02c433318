// A program that solves a beam over a stop with the installed libraries.
#include <cmath>
#include <contct/serve/solved_problem.hpp>
#include <cstdio>

int main() {
  const contct::solved_problem beam(R"(
    beam    = { length = 2.0, elements = 2, EI = 1.0e4 }
    support = [ { node = 1, fix = ["w", "theta"] } ]
    contact = [ { node = 3, surface = "below", face = -0.004, stiffness = 5.0e4 } ]
    step    = [ { point = [ { node = 3, w = -60.0 } ] } ]
  )");
  const double tip = beam.values("w", 1)[2], force = beam.values("force", 1)[0];
  const double right = -260.0 / 53750;  // (3 EI / L^3 + k) w = -60 - 0.004 k
  const int wrong = 3 - beam.certified() - (std::abs(tip - right) < 1e-15) - (force > 41.86 && force < 41.87);
  std::printf("3 facts, %d wrong\n", wrong);
  return wrong;
}
