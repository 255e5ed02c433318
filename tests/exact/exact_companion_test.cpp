// The exact path beside a kernel's, call by call.
#include "contct/exact/exact_companion.hpp"

#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::exact;
using contct::outside::make_kernel;
using contct::path::observer;

namespace {

/// What was beside each increment.
struct beside_log final : observer {
  explicit beside_log(const exact_companion& b) : beside(b) {}
  void incremented(const contct::path::increment& i) override {
    const exact_call* const c = beside.call();
    calls.push_back(c == nullptr ? "-" : std::to_string(c->step) + "." + std::to_string(c->increment));
    if (c != nullptr && beside.parted() == std::nullopt) {
      CHECK(c->step == i.step);
      CHECK(c->increment == i.number);
      CHECK(rounded(c->led_to.fraction) == Approx(i.fraction));
      ++compared;
    }
  }
  const exact_companion& beside;
  std::vector<std::string> calls;
  int compared = 0;
};

struct path_beside {
  std::vector<std::string> calls;
  int compared;
  std::optional<path_place> parted;
  std::string stopped;
};

path_beside follow_beside(const std::string& file, const char* kernel, std::optional<path_place> last = {}) {
  const auto p = contct::read::read_problem(std::string(CONTCT_REFERENCE "/problems/") + file);
  const exact_problem exactly = exact_problem_of(p);
  exact_companion beside(exactly, last);
  beside_log log(beside);
  const auto leader = make_kernel(kernel);
  (void)contct::path::follow(p, contct::path::structure_of(p), "refactor", *leader, {&beside, &log});
  return {log.calls, log.compared, beside.parted(), beside.stopped()};
}

}  // namespace

TEST_CASE("an exact call stands beside each call of PB7, in both precisions") {
  for (const char* kernel : {"fortran", "fortran-r4"}) {
    const path_beside f = follow_beside("pb07-three-gap-supports.toml", kernel);
    CHECK(f.calls == std::vector<std::string>{"1.1", "2.1", "2.2", "3.1", "3.2", "4.1", "4.2", "4.3"});
    CHECK(f.compared == 8);
    CHECK_FALSE(f.parted.has_value());
    CHECK(f.stopped.empty());
  }
}

TEST_CASE("the paths part where single precision decides otherwise, and no call is compared behind") {
  const path_beside f = follow_beside("divergences/single-precision.toml", "fortran-r4");
  REQUIRE(f.parted.has_value());
  CHECK(f.parted->step == 2);
  CHECK(f.parted->increment == 1);
  CHECK(f.calls == std::vector<std::string>{"1.1", "1.2", "2.1", "-"});
  CHECK(f.stopped.empty());
}

TEST_CASE("nothing is computed behind the last place wanted") {
  const auto calls = [](path_place last) {
    return follow_beside("pb07-three-gap-supports.toml", "cpp", last).calls;
  };
  CHECK(calls({2, 1}) == std::vector<std::string>{"1.1", "2.1", "-", "-", "-", "-", "-", "-"});
  CHECK(calls({2, 0}) == std::vector<std::string>{"1.1", "2.1", "2.2", "-", "-", "-", "-", "-"});
}

TEST_CASE("an exact path that ends before the kernel's says why") {
  // A kernel that answers "no event" goes on where the exact path has become a mechanism.
  const auto p = contct::read::read_problem(CONTCT_REFERENCE "/problems/divergences/standstill.toml");
  const exact_problem exactly = exact_problem_of(p);
  exact_companion beside(exactly);
  const contct::kernels::event first[] = {{0, contct::kernels::change::make}};
  path_1989 walk(exactly);
  int number = 0;
  while (walk.next()) {
    beside.incremented({1, ++number, 0.5, 0.5, walk.call().led_to.events});
    CHECK_FALSE(beside.parted().has_value());
  }
  REQUIRE(walk.status() == contct::path::path_status::mechanism);
  beside.incremented({1, number + 1, 0.5, 0.5, first});
  CHECK(beside.call() == nullptr);
  CHECK(beside.stopped() == "it ends before: the structure has become a mechanism");
  REQUIRE(beside.parted().has_value());
  CHECK(beside.parted()->increment == number + 1);
}
