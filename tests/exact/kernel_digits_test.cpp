// Tests the number of correct digits of a kernel's path.
#include "contct/exact/kernel_digits.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using contct::change;
using contct::event;
using contct::path_status;

namespace {

/// A cantilever that reaches its stop at a third of the first step's load, and leaves it in the second step.
struct stop_run {
  contct::problem what = contct::parse_problem(
      "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[contact]]\nnode = 2\n"
      "surface = \"below\"\nface = -1\nstiffness = 3\n[[step]]\npoint = [ { node = 2, w = -9 } ]\n"
      "[[step]]\npoint = [ { node = 2, w = 0 } ]\n",
      "problem.toml");
  exact_path exactly = follow_corrected_path(exact_problem_of(what));

  /// Returns the numbers of correct digits of a path with these errors in its first share and in the first
  /// step's deflection.
  [[nodiscard]] kernel_digits with(double share_error, double w_error, change first = change::make,
                                   path_status ended = path_status::solved) const {
    digit_counter counter(what, exactly);
    const std::vector<event> makes = {{0, first}};
    const std::vector<event> breaks = {{0, change::break_}};
    const std::vector<int> closed = {contct::in_contact};
    const std::vector<int> open = {contct::separated};
    counter.incremented({1, 1, 0.0, 1.0 / 3.0 + share_error, makes});
    counter.step_ended({1, 1.0, std::vector<double>{0, 0, -2 + w_error, -3}, closed, 1.0});
    counter.incremented({2, 1, 0.0, 2.0 / 3.0, breaks});
    counter.step_ended({2, 1.0, std::vector<double>{0, 0, 0, 0}, open, 1.0});
    return counter.result("k", ended, 1e-9);
  }
};

}  // namespace

TEST_CASE("if a kernel's path is correct to the last bit, the kernel has 16 correct digits") {
  const kernel_digits r = stop_run().with(0.0, 0.0);
  CHECK(r.same_events);
  CHECK(r.first_difference.empty());
  CHECK(r.digits == 16.0);
  CHECK(r.force_digits == 16.0);
  CHECK(r.event_digits > 15.5);
}

TEST_CASE(
    "correct digits of a kernel's path are counted separately for displacements, forces and shares of "
    "events") {
  const kernel_digits r = stop_run().with(1e-7, 2e-6);
  CHECK(r.same_events);
  CHECK(r.digits == Approx(6.0));
  CHECK(r.force_digits == Approx(-std::log10(3 * 2e-6 / 3)));
  CHECK(r.event_digits == Approx(7.0));
}

TEST_CASE("an error as large as the number itself leaves no correct digit") {
  CHECK(stop_run().with(0.0, 5.0).digits == 0.0);
}

TEST_CASE(
    "if a kernel's path differs from the exact path, the first different event of both paths is reported") {
  const kernel_digits r = stop_run().with(0.0, 0.0, change::break_);
  CHECK_FALSE(r.same_events);
  CHECK(r.first_difference ==
        "the exact path: pair 1 makes contact in step 1 at share 0.333333333; this kernel: pair 1 breaks "
        "contact in step 1 at share "
        "0.333333333");
}

TEST_CASE("if a kernel's path ends early, its events do not count as those of the exact path") {
  const kernel_digits r = stop_run().with(0.0, 0.0, change::make, path_status::mechanism);
  CHECK_FALSE(r.same_events);
  CHECK_THAT(r.first_difference, Contains("ends before the full load"));
}

TEST_CASE("an event is reported if only the kernel's path or only the exact path has it") {
  const stop_run run;
  const kernel_digits nothing = digit_counter(run.what, run.exactly).result("k", path_status::solved, 1e-9);
  CHECK_THAT(nothing.first_difference, Contains("pair 1 makes") && Contains("no further event"));
  digit_counter counter(run.what, run.exactly);
  const std::vector<event> makes = {{0, change::make}};
  const std::vector<event> breaks = {{0, change::break_}};
  counter.incremented({1, 1, 0.0, 1.0 / 3.0, makes});
  counter.incremented({2, 1, 0.0, 2.0 / 3.0, breaks});
  counter.incremented({2, 2, 0.0, 0.75, makes});
  CHECK_THAT(counter.result("k", path_status::solved, 1e-9).first_difference,
             Contains("pair 1 makes contact in step 2 at share 0.75") &&
                 Contains("does not happen on the exact path"));
}

TEST_CASE("two toggles of a pair that cancel at one share do not count as a difference of events") {
  const stop_run run;
  digit_counter counter(run.what, run.exactly);
  const std::vector<event> makes = {{0, change::make}};
  const std::vector<event> breaks = {{0, change::break_}};
  for (const auto& e : {makes, breaks, makes}) counter.incremented({1, 1, 0.0, 1.0 / 3.0, e});
  counter.incremented({2, 1, 0.0, 2.0 / 3.0, breaks});
  CHECK(counter.result("k", path_status::solved, 1e-9).same_events);

  contct::problem touches = run.what;
  touches.steps.resize(1);
  touches.steps[0].points[0].value = -3;
  const exact_path exactly = follow_corrected_path(exact_problem_of(touches));
  digit_counter early(touches, exactly);
  early.incremented({1, 1, 0.0, 1.0 - 1e-15, makes});
  CHECK(early.result("k", path_status::solved, 1e-9).same_events);
}
