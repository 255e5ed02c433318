// A program that reads a problem file and follows its path with the installed libraries.
#include <contct/kernel/registry.hpp>
#include <contct/path/solve_problem.hpp>
#include <contct/proof/solved_path.hpp>
#include <contct/read/problem_file.hpp>
#include <cstdio>

using namespace contct;

int main() {
  const problem p = parse_problem(
      "[beam]\nx = [0.0, 1.0, 2.0]\nEI = 1.0e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n"
      "[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n",
      "here");
  struct event_counter final : observer {
    int makes = 0;
    void incremented(const increment& i) override {
      for (const event& e : i.events) makes += e.what == change::make ? 1 : 0;
    }
  } counter;
  const auto kernel = make_kernel("cpp");
  const auto path = follow(p, structure_of(p), "refactor", *kernel, {&counter});
  const int wrong = 2 - (path.end.status == path_status::solved) - (counter.makes == 1);
  std::printf("2 facts, %d wrong\n", wrong);
  return wrong;
}
