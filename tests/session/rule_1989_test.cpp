// Tests the comparison of the 1989 rule with the corrected rule: different events, and wrong states.
#include "contct/session/rule_1989.hpp"

#include <string>

#include "catch.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/words.hpp"
#include "read/bad_inputs.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// A problem, and its run by both rules.
struct both_rules {
  const problem what;
  const linear_structure structure = structure_of(what);
  contct::run run{what, structure, {.file = "p.toml", .both_rules = true}};

  explicit both_rules(const std::string& text, const run_outputs& outputs = {})
      : what(parse_problem(text, "p.toml")) {
    run.go(outputs);
  }

  [[nodiscard]] const rule_1989& beside() const { return *run.result.beside; }
  [[nodiscard]] std::vector<state_difference> wrong() const {
    std::vector<state_difference> all;
    for (const state_difference& d : beside().differences)
      if (d.is_wrong()) all.push_back(d);
    return all;
  }
};

std::string divergence(const std::string& name) {
  return read_input(CONTCT_REFERENCE "/problems/divergences/" + name + ".toml");
}

/// Returns a plate on a bed with this number of elements along each side.
std::string square(int elements) {
  const std::string n = std::to_string(elements);
  return "[plate]\nsize = [1, 1]\nelements = [" + n + ", " + n +
         "]\nD = 1\nnu = 0.3\n[[bed]]\nmodulus = 1\nface = 0\n[[step]]\nuniform = -1\n";
}

}  // namespace

TEST_CASE("events at the same share in another order do not count as a difference of the 1989 rule") {
  const both_rules pb7(read_input(CONTCT_REFERENCE "/problems/pb07-three-gap-supports.toml"));
  CHECK(pb7.run.result.kernels == std::vector<std::string>{"corrected", "fortran", "cpp"});
  CHECK(pb7.beside().same_events);
  CHECK(pb7.beside().differences.size() == 4);
  CHECK(pb7.wrong().empty());
  CHECK(pb7.beside().compared.calls() == 8);
  CHECK(pb7.beside().compared.compared().mismatches == 0);
  CHECK_THAT(rule_1989_words(pb7.run.result).at(0), Contains("comes to the same states: every number"));
}

TEST_CASE(
    "an error of the 1989 rule that remains after unloading is reported, with the wrong and the right "
    "value") {
  const both_rules near(divergence("near-tie"));
  REQUIRE(near.wrong().size() == 2);
  const state_difference unloaded = near.wrong()[1];
  CHECK(unloaded.step == 2);
  CHECK(unloaded.what == quantity::w);
  CHECK(unloaded.at == "node 3");
  CHECK(unloaded.value == Approx(0.5 * 8 / 30000).epsilon(1e-9));
  CHECK(unloaded.right == 0.0);
  CHECK(near.run.result.judged.all_certified());
  CHECK(near.run.exit() == exit_status::solved);
}

TEST_CASE("if the 1989 rule has an event at another share, the report gives the share of this event") {
  const both_rules near(divergence("near-tie"));
  const std::vector<row_of_1989>& first = near.beside().rows.at(0);
  CHECK(first.at(0).otherwise.empty());
  REQUIRE(first.at(1).otherwise.size() == 1);
  CHECK(first[1].otherwise[0].what == event{1, change::make});
  CHECK(first[1].otherwise[0].at.value_or(0) ==
        Approx(0.25));  // the load is 15 of 60 when the stop is reached
  CHECK_FALSE(near.beside().same_events);
}

TEST_CASE(
    "if only the 1989 rule has an event, the report gives the event with the next increment of the corrected "
    "rule") {
  const both_rules marked(divergence("mark-toggled"));
  const row_of_1989& first = marked.beside().rows.at(0).at(0);
  REQUIRE(first.otherwise.size() == 1);
  CHECK(first.otherwise[0].what == event{0, change::make});
  REQUIRE(marked.wrong().size() == 1);
  CHECK(marked.wrong()[0].at == "pair 1");
  CHECK(marked.wrong()[0].value == Approx(-5e4));  // stiffness 5e4 times distance 1
  CHECK(marked.wrong()[0].right == 0.0);
}

TEST_CASE(
    "if the path of the 1989 rule ends early, the report says so, and the corrected answer does not change") {
  const both_rules lost(divergence("standstill"));
  CHECK(lost.run.exit() == exit_status::solved);
  CHECK(lost.beside().end.status == path_status::path_ended);
  CHECK_FALSE(lost.beside().rows.at(0).back().reached);
  CHECK(lost.beside().differences.empty());
  const std::string words = rule_1989_words(lost.run.result).at(0);
  CHECK_THAT(words, Contains("the path of the 1989 rule ends early") && Contains("There is an equilibrium") &&
                        !Contains("--kernels"));
}

TEST_CASE(
    "the 1989 rule uses the engine refactor, or a faster engine on a large problem if its calls are not "
    "kept") {
  CHECK(both_rules(square(4)).beside().engine == "refactor");
  const std::string large = square(40);
  CHECK(both_rules(large).beside().engine == "updated");
  std::string trace;
  output_file to(&trace);
  CHECK(both_rules(large, {.trace = &to}).beside().engine == "refactor");
  CHECK_THAT(trace, Contains("\nkernel fortran\n"));
}
