// Tests the messages and exit statuses for the end of a path, without running the program.
#include "app/problem_runs.hpp"

#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

/// Returns a beam with ten pairs at nodes 2 to 11, alternately below and above.
problem ten_pairs() {
  std::string text =
      "[beam]\nlength = 10.0\nelements = 10\nEI = 1.0\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
  for (int node = 2; node <= 11; ++node)
    text += "[[contact]]\nnode = " + std::to_string(node) +
            "\nsurface = " + (node % 2 == 0 ? "\"below\"\nface = -1.0" : "\"above\"\nface = 1.0") +
            "\nstiffness = 1.0\n";
  return parse_problem(text + "[[step]]\nuniform = 1.0\n", "ten.toml");
}

path_end ended(path_status status, std::vector<int> pairs = {}, double fraction = 0.25) {
  path_end end;
  end.status = status;
  end.step = 3;
  end.fraction = fraction;
  end.pairs = std::move(pairs);
  return end;
}

step_state state_with(double rcond, int step) {
  return {step, 1.0, {}, {}, rcond, false};
}

}  // namespace

TEST_CASE(
    "the message about a path that fails has the step, the share, and the number, node and surface of each "
    "pair") {
  const problem p = ten_pairs();
  for (const path_status status :
       {path_status::mechanism, path_status::cycle, path_status::iteration_limit, path_status::not_factored})
    CHECK_THAT(end_words(p, ended(status, {0, 1})), StartsWith("step 3, at share 0.25 of its load: "));
  CHECK_THAT(end_words(p, ended(path_status::mechanism, {0, 1})),
             Contains("no equilibrium") && Contains("pair 1 (node 2, below), pair 2 (node 3, above)"));
  CHECK_THAT(end_words(p, ended(path_status::cycle, {9})), Contains("pair 10 (node 11, above)"));
  CHECK_THAT(end_words(p, ended(path_status::iteration_limit)),
             EndsWith("the limit of increments (--max-increments) is reached"));
  CHECK_THAT(end_words(p, ended(path_status::not_factored)), Contains("ill-conditioned"));
}

TEST_CASE("the message about a path that fails names at most eight pairs, and counts the other pairs") {
  const std::string words = end_words(ten_pairs(), ended(path_status::cycle, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  CHECK_THAT(words, Contains("pair 8 (") && Contains(" and 2 more") && !Contains("pair 9 ("));
  CHECK_THAT(end_words(ten_pairs(), ended(path_status::cycle, {0, 1, 2, 3, 4, 5, 6, 7})), !Contains("more"));
}

TEST_CASE(
    "the message about a path that ended early says if an equilibrium exists, and which kernel reaches it") {
  path_end early = ended(path_status::path_ended, {0});
  early.by_1989_rule = true;
  CHECK_THAT(end_words(ten_pairs(), early),
             Contains("when pair 1 (node 2, below) separated, nothing held the structure") &&
                 EndsWith("is not decided") && !Contains("--kernels"));
  early.has_equilibrium = true;
  CHECK_THAT(end_words(ten_pairs(), early), EndsWith("There is an equilibrium under the load of this step: "
                                                     "--kernels corrected reaches it"));
  early.by_1989_rule = false;
  CHECK_THAT(end_words(ten_pairs(), early), EndsWith("There is an equilibrium under the load of this step"));
  path_end cycle = ended(path_status::cycle, {9});
  cycle.has_equilibrium = false;
  CHECK_THAT(end_words(ten_pairs(), cycle), EndsWith("There is no equilibrium under the load of this step"));
}

TEST_CASE("if nothing holds the structure, the message suggests a support and no other kernel") {
  CHECK_THAT(end_words(ten_pairs(), ended(path_status::mechanism)),
             Contains("a rigid-body motion") && Contains("Add a support") && !Contains("--kernels"));
}

TEST_CASE(
    "contct run has different exit statuses for a mechanism, a limit and a matrix that cannot be factored") {
  CHECK(status_of(path_status::solved) == exit_status::solved);
  CHECK(status_of(path_status::mechanism) == exit_status::mechanism);
  CHECK(status_of(path_status::path_ended) == exit_status::iteration_limit);
  CHECK(status_of(path_status::cycle) == exit_status::iteration_limit);
  CHECK(status_of(path_status::iteration_limit) == exit_status::iteration_limit);
  CHECK(status_of(path_status::not_factored) == exit_status::bad_input);
}

TEST_CASE("if a step has fewer than five correct digits, contct run warns about the step with the fewest") {
  run_recorder seen;
  seen.step_ended(state_with(1e-3, 1));
  CHECK(digit_warning(seen.steps).empty());
  seen.step_ended(state_with(1e-13, 2));
  seen.step_ended(state_with(1e-9, 3));
  CHECK_THAT(digit_warning(seen.steps), StartsWith("step 2: ") && Contains("rcond 1.0e-13"));
  seen.step_ended(state_with(1e-17, 4));
  CHECK_THAT(digit_warning(seen.steps), StartsWith("step 4: no digit "));
}
