// Tests the record of a path, from which outputs are written.

#include "contct/session/run_result.hpp"

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "read/good_problem.hpp"

using namespace contct;

namespace {

/// Passes a call to `r`, with the answer `ss` and this text of unit 26.
void tell_call(run_recorder& r, std::vector<double> ss, std::string_view text) {
  std::vector<int> isep(ss.size(), separated);
  const call<double> c{{}, {}, {}, ss, 0.5, {}, isep, {}, {1, 1}};
  r.called({c, isep, text});
}

}  // namespace

TEST_CASE("a run keeps its first calls, each with the s of the first pairs, and counts all calls") {
  run_recorder r(nullptr, {.calls = true});
  for (int i = 0; i < 1205; ++i) tell_call(r, std::vector<double>(10, i), "x");
  CHECK(r.all_calls == 1205);
  REQUIRE(r.calls.size() == run_recorder::most_calls);
  CHECK(r.calls[7].ss == std::vector<double>(run_recorder::most_ss, 7.0));
  CHECK(r.calls[7].smin == 0.5);
  CHECK(r.calls[7].followers.empty());
}

TEST_CASE("a run keeps the text of unit 26 up to a limit of characters, and counts all characters") {
  run_recorder r(nullptr, {.calls = true});
  const std::string most(150'000, 'a');
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, "short");
  CHECK(r.log == most);
  CHECK(r.all_log == 300'005);
}

TEST_CASE(
    "a recorded call has the step number of the increment that follows it, or 0 if another call follows "
    "instead") {
  run_recorder r(nullptr, {.calls = true});
  tell_call(r, {1.0}, "");
  r.incremented({1, 1, 0.5, 0.5, {}});
  r.incremented({1, 2, 1.0, 0.5, {}, true});  // a snap has no call
  tell_call(r, {1.0}, "");
  tell_call(r, {1.0}, "");
  r.incremented({2, 1, 1.0, 1.0, {}});
  REQUIRE(r.calls.size() == 3);
  CHECK(r.calls[0].number == 1);
  CHECK(r.calls[1].step == 0);
  CHECK(r.calls[2].step == 2);
}

TEST_CASE("calls of a run are recorded only on request") {
  run_recorder r;
  tell_call(r, {1.0}, "text");
  CHECK(r.calls.empty());
  CHECK(r.log.empty());
}

TEST_CASE("a recorded step has its increments with events, and the final state that the path reported") {
  run_recorder r;
  const event make{3, change::make};
  const std::vector<double> u = {0.0, 1.0};
  const std::vector<int> isep = {in_contact};
  r.incremented({1, 1, 0.5, 0.5, {&make, 1}});
  r.incremented({1, 2, 1.0, 1.0, {}, true});
  r.step_ended({1, 1.0, u, isep, 0.25});
  r.step_ended({2, 0.5, u, isep, 0.25, true});
  REQUIRE(r.steps.size() == 2);
  REQUIRE(r.steps[0].increments.size() == 2);
  CHECK(r.steps[0].increments[0].events == std::vector<event>{make});
  CHECK(r.steps[0].increments[1].snaps);
  CHECK(r.steps[0].end.displacement == u);
  CHECK(r.steps[0].rcond == 0.25);
  CHECK(r.steps[1].increments.empty());
  CHECK(r.steps[1].from_fallback);
}

TEST_CASE("if a problem has no title, the title of the run is the file name") {
  const auto title = [](const std::string& text, const std::string& file) {
    return title_of(parse_problem(text, "pb.toml"), file);
  };
  CHECK(title(std::string("title = \"two\\nlines\"\n") + good_problem, "a/b.toml") == "two lines");
  CHECK(title(std::string("title = \" \\n\"\n") + good_problem, "a/b.toml") == "b.toml");
  CHECK(title(good_problem, "-") == "A problem from standard input");
}
