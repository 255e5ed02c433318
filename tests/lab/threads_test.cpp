// Tests paths, certificates and kernels in many threads. Under ThreadSanitizer (preset tsan) a data race
// fails the test.
#include <atomic>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_problem.hpp"

using namespace contct;

namespace {

std::vector<double> errors_of(const problem_result& r) {
  std::vector<double> errors;
  for (const certificate& c : r.certificates) errors.push_back(c.displacement_error);
  return errors;
}

}  // namespace

TEST_CASE("sixteen threads follow different paths, and each path equals the same path in a single thread") {
  constexpr std::size_t threads = 16;
  constexpr std::size_t problems = 6;
  const char* const engines[] = {"refactor", "updated"};
  random_problem_kind kind;
  kind.most_elements = 8;
  kind.most_lines = 3;
  // Returns the result of thread t for its problem i. Only one thread uses the listing, because unit 26
  // belongs to the whole process.
  const auto result_of = [&](std::size_t t, std::size_t i) {
    const random_problem p = make_random_problem(2026, t * problems + i + 1, kind);
    const char* const leader = t == 0 ? "fortran" : (t + i) % 2 == 0 ? "cpp" : "corrected";
    return try_problem(p, *make_kernel(leader), engines[i % 2]);
  };
  std::vector<problem_result> expected;
  for (std::size_t n = 0; n < threads * problems; ++n)
    expected.push_back(result_of(n / problems, n % problems));
  std::atomic<int> right = 0;
  std::vector<std::thread> all;
  for (std::size_t t = 0; t < threads; ++t)
    all.emplace_back([&, t] {
      for (std::size_t i = 0; i < problems; ++i) {
        const problem_result found = result_of(t, i);
        const problem_result& wanted = expected[t * problems + i];
        if (found.came_to == wanted.came_to && errors_of(found) == errors_of(wanted)) ++right;
      }
    });
  for (std::thread& t : all) t.join();
  CHECK(right == threads * problems);
}
