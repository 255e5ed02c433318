// Tests fuzz runs on calls and on whole problems: their counts, their report on a follower with other
// answers, and their failure if too little was compared.
#include "contct/lab/fuzz.hpp"

#include <cmath>
#include <stdexcept>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"

using namespace contct;

namespace {

fuzz_result of_calls(std::vector<std::string> kernels, std::int64_t calls = 1, int shard = 1,
                     int shards = 1) {
  return run_fuzz({std::move(kernels), calls, 0, 5, shard, shards}).result;
}

/// An answered call in which a pair at its face separates, and a pair with a gap of 1 makes contact.
struct two_toggles {
  std::vector<double> dd = {0.0, 0.0}, dtest = {1.0, 1.0}, cc = {1e-11, 1.0}, ss = {0.5, 0.5};
  std::vector<int> id = {1, 2}, before = {in_contact, separated}, after = {separated, in_contact},
                   isurf = {1, 1};
  call<double> c{dd, dtest, cc, ss, 0.5, id, after, isurf, {}};
};

fuzz_result full_result(std::int64_t calls, std::int64_t each) {
  fuzz_result r;
  r.calls = calls;
  r.events = {each, each, each};
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true}) r.branches.of(static_cast<branch>(b), outcome) += each;
  }
  r.followers.emplace_back().compared = {10 * calls, 0};
  return r;
}

}  // namespace

TEST_CASE("the shards of a fuzz run together compare the same calls as a run without shards") {
  std::vector<branch_counts> counts;
  std::vector<std::int64_t> calls;
  for (const int stride : {1, 3}) {
    counts.emplace_back();
    calls.push_back(0);
    for (int shard = 1; shard <= stride; ++shard) {
      const fuzz_result h = of_calls({"fortran", "cpp"}, 3000, shard, stride);
      counts.back().add(h.branches);
      calls.back() += h.calls;
      CHECK(h.followers[0].compared.mismatches == 0);
      CHECK(h.followers[0].compared.values > 3 * h.calls);
    }
  }
  CHECK(calls == std::vector<std::int64_t>{3000, 3000});
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true})
      CHECK(counts[0].of(static_cast<branch>(b), outcome) == counts[1].of(static_cast<branch>(b), outcome));
  }
}

TEST_CASE("contct fuzz refuses kernels of different rules or precisions") {
  CHECK_THROWS_AS(of_calls({"fortran", "corrected"}), std::invalid_argument);
  CHECK_THROWS_AS(of_calls({"fortran", "cpp-r4"}), std::invalid_argument);
  CHECK_THROWS_AS(of_calls({"fortran", "nobody"}), std::invalid_argument);
}

TEST_CASE("contct fuzz counts makes, breaks, and events of pairs within EPSGAP of their faces") {
  two_toggles t;
  fuzz_result r;
  r.count(t.c, t.before);
  r.count(t.c, t.after);  // a call without events
  CHECK(r.calls == 2);
  CHECK(r.events.make == 1);
  CHECK(r.events.break_ == 1);
  CHECK(r.events.stationary == 1);
  CHECK(r.branches.of(branch::stationary, true) == 2);
}

TEST_CASE(
    "for each follower, contct fuzz has the largest difference in ULPs, and says if all events are equal") {
  const call_inputs<double> in{{0.0}, {1.0}, {0.5}, {1}, {separated}, {face_above}, {}};
  call_outputs out;
  call<double> led = out.prepare(in);
  led.smin = std::nextafter(0.5, 1.0);
  led.ss[0] = std::nextafter(led.smin, 1.0);
  led.isep[0] = in_contact;
  std::vector<std::unique_ptr<kernel>> followers;
  followers.push_back(make_kernel("cpp"));
  lockstep compared(facts_of_kernel("cpp"), std::move(followers));
  compared.put({led, in.isep, {}, 1});
  const nearness& r = compared.followers()[0].near;
  CHECK(r.most_ulps == 2);
  CHECK(r.same_events);
  CHECK(r.always_answered);
  led.isep[0] = separated;
  compared.put({led, in.isep, {}, 2});
  CHECK_FALSE(r.same_events);
}

TEST_CASE(
    "contct fuzz fails if calls, values, events or outcomes of any IF are fewer than the least allowed "
    "numbers") {
  CHECK(floors_missed(full_result(100'000, 10)).empty());
  CHECK_THAT(floors_missed(full_result(100'000, 9)),
             Catch::Matchers::Contains("make: 9, break: 9, stationary: 9"));
  fuzz_result one_missing = full_result(100'000, 10);
  --one_missing.branches.of(branch::no_events, true);
  CHECK_THAT(floors_missed(one_missing),
             Catch::Matchers::Contains("found no_events true: 9; allowed: at least 10"));
  CHECK_THAT(floors_missed(full_result(0, 10)), Catch::Matchers::Contains("nothing was compared"));
  fuzz_result nobody = full_result(100'000, 10);
  nobody.followers.clear();
  CHECK_THAT(floors_missed(nobody), Catch::Matchers::Contains("nothing was compared"));
}

TEST_CASE(
    "contct fuzz --problems compares every call of every path, and compares the same calls in each run") {
  fuzz_request r;
  r.calls = 1;
  r.problems = 20;
  const fuzz_run run = run_fuzz(r);
  CHECK(run.result.problems == 20);
  CHECK(run.result.calls > 40);
  REQUIRE(run.result.followers.size() == 1);
  CHECK(run.result.followers[0].compared.mismatches == 0);
  CHECK(run.result.followers[0].compared.values > 4 * run.result.calls);
  CHECK(run.result.followers[0].highest == equality_level::bits);
  CHECK(run.cases.empty());
  const fuzz_result again = run_fuzz(r).result;
  CHECK(again.calls == run.result.calls);
  CHECK(again.events.make == run.result.events.make);
}
