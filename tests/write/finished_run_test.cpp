// What is kept of a run for its page.
#include "contct/write/finished_run.hpp"

#include "catch.hpp"
#include "read/bad_inputs.hpp"
#include "support/a_run.hpp"
#include "support/one_pair.hpp"

using namespace contct::app;

namespace {

/// Tell `r` of a call whose answer is `ss`, with this text of unit 26.
void tell_call(run_record& r, std::vector<double> ss, std::string_view text) {
  std::vector<int> isep(ss.size(), separated);
  const call<double> c{{}, {}, {}, ss, 0.5, {}, isep, {}, {1, 1}};
  r.called({c, isep, text});
}

}  // namespace

TEST_CASE("the first calls are kept with the s of their first pairs, all are counted") {
  run_record r(nullptr);
  for (int i = 0; i < 1205; ++i) tell_call(r, std::vector<double>(10, i), "x");
  CHECK(r.all_calls == 1205);
  REQUIRE(r.calls.size() == run_record::most_calls);
  CHECK(r.calls[7].ss == std::vector<double>(run_record::most_ss, 7.0));
  CHECK(r.calls[7].smin == 0.5);
  CHECK(r.calls[7].followers.empty());
}

TEST_CASE("unit 26 is kept in whole calls only, and nothing behind one that was left out") {
  run_record r(nullptr);
  const std::string most(150'000, 'a');
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, most);
  tell_call(r, {1.0}, "short");
  CHECK(r.log == most);
  CHECK(r.all_log == 300'005);
}

TEST_CASE("a call has the increment it led to, or none") {
  run_record r(nullptr);
  tell_call(r, {1.0}, "");
  r.incremented({1, 1, 0.5, 0.5, {}});
  r.incremented({1, 2, 1.0, 0.5, {}, true});  // a snap, without a call
  tell_call(r, {1.0}, "");
  tell_call(r, {1.0}, "");
  r.incremented({2, 1, 1.0, 1.0, {}});
  REQUIRE(r.calls.size() == 3);
  CHECK(r.calls[0].number == 1);
  CHECK(r.calls[1].step == 0);
  CHECK(r.calls[2].step == 2);
  REQUIRE(r.increments.size() == 3);
  CHECK(r.increments[1].snaps);
  CHECK(r.increments[2].fraction == 1.0);
}

TEST_CASE("the first increments are kept, all are counted") {
  run_record r(nullptr);
  const event make{3, change::make};
  for (int i = 1; i <= 1201; ++i) r.incremented({1, i, 0.5, 0.5, {&make, 1}});
  CHECK(r.all_increments == 1201);
  REQUIRE(r.increments.size() == run_record::most_increments);
  CHECK(r.increments.back().number == 1200);
  CHECK(r.increments.back().events == std::vector<event>{make});
}

TEST_CASE("a run without a title has its file's name") {
  const auto title = [](const std::string& text, const std::string& file) {
    const a_run of(text);
    finished_run r = of.finished();
    r.file = file;
    return title_of(r);
  };
  CHECK(title(std::string("title = \"two\\nlines\"\n") + good_problem, "a/b.toml") == "two lines");
  CHECK(title(std::string("title = \" \\n\"\n") + good_problem, "a/b.toml") == "b.toml");
  CHECK(title(good_problem, "-") == "A problem from standard input");
}
