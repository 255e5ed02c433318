// A whole path from the installed rooms: PB1, a cantilever over a stop at its tip.
#include <cmath>
#include <contct/kernel/registry.hpp>
#include <contct/model/problem.hpp>
#include <contct/path/solve_problem.hpp>
#include <cstdio>

using namespace contct;

namespace {

/// Keeps the deflection of the tip at each step's end.
struct tip_watcher final : observer {
  std::vector<double> w;
  void step_ended(const step_state& s) override { w.push_back(s.displacement[4]); }
};

}  // namespace

int main() {
  const beam beam{{0, 1, 2}, {1e4, 1e4}};
  const std::vector<support> clamp = {{0, 0, true}, {0, 1, true}};
  const auto structure = build(beam, clamp, {{2, face_below, -0.004, 5e4, false}});
  const std::vector<load> steps = {{{{2, 0, -10.0}}, {}}, {{{2, 0, -60.0}}, {}}};
  tip_watcher tip;
  observer* const observers[] = {&tip};
  const auto kernel = make_kernel("fortran");
  const auto end = follow_steps(beam, structure, steps, "refactor", *kernel, observers);

  const double flexibility = 8.0 / 3 / 1e4;
  const double stop = (60 * flexibility - 0.004) / (flexibility + 1 / 5e4);
  const bool solved = end.status == path_status::solved && tip.w.size() == 2;
  const bool free = solved && std::abs(tip.w[0] + 10 * flexibility) < 1e-14;
  const bool stopped = solved && std::abs(tip.w[1] + 0.004 + stop / 5e4) < 1e-14;
  std::printf("%d facts, %d wrong\n", 3, 3 - solved - free - stopped);
  return solved && free && stopped ? 0 : 1;
}
