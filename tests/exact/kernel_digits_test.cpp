// Tests the number of correct digits of a kernel's path.
#include <cmath>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/exact_run.hpp"

using namespace contct;

namespace {

/// A cantilever that reaches its stop at a third of the first step's load, and leaves it in the second step.
struct stop_run {
  explicit stop_run(
      const std::string& steps = "[[step]]\npoint = [ { node = 2, w = -9 } ]\n[[step]]\nuniform = 0\n")
      : what(parse_problem("[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
                           "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1\nstiffness = 3\n" +
                               steps,
                           "problem.toml")),
        exactly(follow_corrected_path(exact_problem_of(what))) {}

  struct toggle {
    int step;
    double share;
    change what;
  };
  /// Returns the numbers of correct digits of a path with these events, and this error in the first step's
  /// deflection.
  [[nodiscard]] kernel_digits with(const std::vector<toggle>& toggles, double w_error = 0.0,
                                   path_status ended = path_status::solved) const {
    recorded_path path;
    int number = 0;
    for (const toggle& t : toggles) {
      const std::vector<event> events = {{0, t.what}};
      path.record.incremented({t.step, ++number, 0.0, t.share, events});
    }
    path.record.take(
        {{{.step = 1, .fraction = 1.0, .displacement = {0, 0, -2 + w_error, -3}, .isep = {in_contact}}},
         {{.step = 2, .fraction = 1.0, .displacement = {0, 0, 0, 0}, .isep = {separated}}}});
    path.end.status = ended;
    return digits_on(path, "k", what, exactly, 1e-9);
  }

  problem what;
  exact_path exactly;
};

constexpr double third = 1.0 / 3.0;
constexpr stop_run::toggle makes{1, third, change::make};
constexpr stop_run::toggle breaks{2, 2.0 / 3.0, change::break_};

}  // namespace

TEST_CASE("if a kernel's path is correct to the last bit, the kernel has 16 correct digits") {
  const kernel_digits r = stop_run().with({makes, breaks});
  CHECK(r.same_events);
  CHECK(r.first_difference.empty());
  CHECK(r.digits == 16.0);
  CHECK(r.force_digits == 16.0);
  CHECK(r.event_digits > 15.5);
}

TEST_CASE(
    "correct digits of a kernel's path are counted separately for displacements, forces and shares of "
    "events") {
  const kernel_digits r = stop_run().with({{1, third + 1e-7, change::make}, breaks}, 2e-6);
  CHECK(r.same_events);
  CHECK(r.digits == Approx(6.0));
  CHECK(r.force_digits == Approx(-std::log10(3 * 2e-6 / 3)));
  CHECK(r.event_digits == Approx(7.0));
  CHECK(stop_run().with({makes, breaks}, 5.0).digits == 0.0);  // an error as large as the number
}

TEST_CASE("the first event that only the kernel's path or only the exact path has is reported") {
  const std::pair<kernel_digits, std::string> rows[] = {
      {stop_run().with({{1, third, change::break_}, breaks}),
       "the exact path: pair 1 makes contact in step 1 at share 0.333333333; this kernel: pair 1 breaks "
       "contact in "
       "step 1 at share 0.333333333"},
      {stop_run().with({makes, breaks}, 0.0, path_status::mechanism), "ends before the full load"},
      {stop_run().with({}), "pair 1 makes"},
      {stop_run().with({}), "no further event"},
      {stop_run().with({makes, breaks, {2, 0.75, change::make}}),
       "pair 1 makes contact in step 2 at share 0.75"},
      {stop_run().with({makes, breaks, {2, 0.75, change::make}}), "does not happen on the exact path"}};
  for (const auto& [digits, words] : rows) {
    CHECK_FALSE(digits.same_events);
    CHECK_THAT(digits.first_difference, Contains(words));
  }
}

TEST_CASE("two toggles of a pair that cancel at one share do not count as a difference of events") {
  CHECK(stop_run().with({makes, {1, third, change::break_}, makes, breaks}).same_events);
  const stop_run touches("[[step]]\npoint = [ { node = 2, w = -3 } ]\n");
  CHECK(touches.with({{1, 1.0 - 1e-15, change::make}}).same_events);
}
