// A program that reads a problem file and follows its path with the installed libraries.
#include <contct/kernel/registry.hpp>
#include <contct/path/solve_problem.hpp>
#include <contct/read/problem_file.hpp>
#include <cstdio>

using namespace contct;

namespace {

constexpr const char* text = R"(
[beam]
x  = [0.0, 1.0, 2.0]
EI = 1.0e4
[[support]]
node = 1
fix  = ["w", "theta"]
[[contact]]
node      = 3
surface   = "below"
face      = -0.004
stiffness = 5.0e4
[[step]]
point = [ { node = 3, w = -60.0 } ]
)";

/// Counts the events of a path.
struct event_counter final : observer {
  int makes = 0;
  void incremented(const increment& i) override {
    for (const event& e : i.events) makes += e.what == change::make ? 1 : 0;
  }
};

}  // namespace

int main() {
  const problem p = parse_problem(text, "here");
  event_counter counter;
  const auto kernel = make_kernel("cpp");
  const auto end = follow(p, structure_of(p), "refactor", *kernel, {&counter});
  const bool solved = end.status == path_status::solved;
  const bool touched = counter.makes == 1;
  std::printf("%d facts, %d wrong\n", 2, 2 - solved - touched);
  return solved && touched ? 0 : 1;
}
