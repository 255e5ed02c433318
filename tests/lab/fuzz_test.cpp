// Floors: a run that compared too little says what is missing.
#include "contct/lab/fuzz.hpp"

#include "catch.hpp"

using namespace contct::app;

namespace {

fuzz_result full_result(std::int64_t calls, std::int64_t each) {
  fuzz_result r;
  r.calls = calls;
  r.events = {each, each, each};
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true}) r.branches.add(static_cast<branch>(b), outcome, each);
  }
  r.followers.push_back({"cpp", {10 * calls, 0}, equality_level::bits, 0, {}});
  return r;
}

}  // namespace

TEST_CASE("a run is floored on calls, values, events by kind and every outcome of every IF") {
  CHECK(floors_missed(full_result(100'000, 10)).empty());
  CHECK_THAT(floors_missed(full_result(100'000, 9)),
             Catch::Matchers::Contains("make: 9, break: 9, stationary: 9"));
  fuzz_result one_missing = full_result(100'000, 10);
  one_missing.branches.add(branch::no_events, true, -1);
  CHECK_THAT(floors_missed(one_missing),
             Catch::Matchers::Contains("found no_events true: 9; allowed: at least 10"));
  CHECK_THAT(floors_missed(full_result(0, 10)), Catch::Matchers::Contains("nothing was compared"));
  fuzz_result nobody = full_result(100'000, 10);
  nobody.followers.clear();
  CHECK_THAT(floors_missed(nobody), Catch::Matchers::Contains("nothing was compared"));
}

TEST_CASE("a fuzz run on whole problems compares every call of every path") {
  fuzz_request r;
  r.calls = 1;
  r.problems = 20;
  const fuzz_run run = run_fuzz(r);
  CHECK(run.result.problems == 20);
  CHECK(run.result.calls > 40);
  CHECK(run.result.followers.at(0).compared.mismatches == 0);
  CHECK(run.result.followers.at(0).compared.values > 4 * run.result.calls);
  CHECK(run.result.followers.at(0).highest == equality_level::bits);
  CHECK(run.cases.empty());
}
