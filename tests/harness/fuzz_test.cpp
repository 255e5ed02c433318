// Tests fuzz runs on calls and on whole problems, the floors of their counts, and that a mismatch is shrunk
// to fewer calls, fewer pairs and rounder numbers that still give different answers.
#include "contct/harness/fuzz.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/harness/random_calls.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/results/random_problem.hpp"

using namespace contct;

namespace {

fuzz_result of_calls(std::vector<std::string> kernels, std::int64_t calls = 1, int shard = 1,
                     int shards = 1) {
  return run_fuzz({std::move(kernels), calls, 0, 5, shard, shards}, nullptr).result;
}

std::vector<std::int64_t> counts_of(const branch_counts& branches) {
  std::vector<std::int64_t> counts;
  for (std::size_t b = 0; b < branch_names.size(); ++b)
    for (const bool outcome : {false, true}) counts.push_back(branches.of(static_cast<branch>(b), outcome));
  return counts;
}

fuzz_result full_result(std::int64_t calls, std::int64_t each) {
  fuzz_result r;
  r.calls = calls;
  r.events = {each, each, each};
  for (std::size_t b = 0; b < branch_names.size(); ++b)
    for (const bool outcome : {false, true}) r.branches.of(static_cast<branch>(b), outcome) += each;
  r.followers.emplace_back().compared = {10 * calls, 0};
  return r;
}

/// Returns true if a pair in contact has gap / d* between 0.1 and 1/3.
bool approaches(const call_inputs& in) {
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    const std::size_t dof = in.dof_of_pair(i);
    const double s = (in.cc[i] - in.dd[dof]) / in.dtest[dof];
    if (s > 0.1 && s < 1.0 / 3 && in.isep[i] == in_contact) return true;
  }
  return false;
}

/// Returns random calls, of which the last one approaches.
call_sequence some_calls(std::size_t count) {
  call_source source(1989, 8);
  call_sequence calls;
  std::uint64_t n = 1;
  for (; calls.size() + 1 < count; ++n) calls.push_back(source.at(n));
  while (!approaches(source.at(n))) ++n;
  calls.push_back(source.at(n));
  return calls;
}

}  // namespace

TEST_CASE("the shards of a fuzz run together compare the same calls as a run without shards") {
  std::vector<std::int64_t> sum(2 * branch_names.size());
  std::int64_t calls = 0;
  for (int shard = 1; shard <= 3; ++shard) {
    const fuzz_result h = of_calls({"fortran", "cpp"}, 3000, shard, 3);
    std::ranges::transform(sum, counts_of(h.branches), sum.begin(), std::plus());
    calls += h.calls;
    CHECK(h.followers[0].compared.mismatches == 0);
    CHECK(h.followers[0].compared.values > 3 * h.calls);
  }
  const fuzz_result whole = of_calls({"fortran", "cpp"}, 3000);
  CHECK(whole.calls == 3000);
  CHECK(calls == 3000);
  CHECK(sum == counts_of(whole.branches));
}

TEST_CASE("contct fuzz counts makes, breaks, and events of pairs within EPSGAP of their faces") {
  // A pair at its face separates, and a pair with a gap of 1 makes contact.
  const call_inputs in{{0.0, 0.0}, {1.0, 1.0}, {1e-11, 1.0}, {1, 2}, {in_contact, separated}, {1, 1}, {}};
  call_outputs out;
  call<double> c = out.prepare(in);
  c.smin = 0.5;
  out.ss = {0.5, 0.5};
  out.isep = {separated, in_contact};
  fuzz_result r;
  r.count(c, in.isep);
  r.count(c, out.isep);  // a call without events
  CHECK(r.calls == 2);
  CHECK(r.events.make == 1);
  CHECK(r.events.break_ == 1);
  CHECK(r.events.stationary == 1);
  CHECK(r.branches.of(branch::stationary, true) == 2);
}

TEST_CASE("contct fuzz fails if calls, values, events or outcomes of any IF are too few") {
  CHECK(floors_missed(full_result(100'000, 10)).empty());
  CHECK_THAT(floors_missed(full_result(100'000, 9)), Contains("make: 9, break: 9, stationary: 9"));
  CHECK_THAT(floors_missed(full_result(0, 10)), Contains("nothing was compared"));
  fuzz_result one_missing = full_result(100'000, 10), nobody = one_missing;
  --one_missing.branches.of(branch::no_events, true);
  CHECK_THAT(floors_missed(one_missing), Contains("found no_events true: 9; allowed: at least 10"));
  nobody.followers.clear();
  CHECK_THAT(floors_missed(nobody), Contains("nothing was compared"));
}

TEST_CASE("contct fuzz --problems compares every call of every path, the same calls in each run") {
  fuzz_request r;
  r.calls = 1;
  r.problems = 20;
  const small_problems problems(r.seed);
  const fuzz_run run = run_fuzz(r, &problems);
  CHECK(run.result.problems == 20);
  CHECK(run.result.calls > 40);
  REQUIRE(run.result.followers.size() == 1);
  CHECK(run.result.followers[0].compared.mismatches == 0);
  CHECK(run.result.followers[0].compared.values > 4 * run.result.calls);
  CHECK(run.result.followers[0].highest == equality_level::bits);
  CHECK(run.cases.empty());
  const fuzz_result again = run_fuzz(r, &problems).result;
  CHECK(again.calls == run.result.calls);
  CHECK(again.events.make == run.result.events.make);
}

TEST_CASE("if one pair of one call is enough for a difference, shrinking leaves this pair, rounded") {
  const call_sequence small =
      shrink(some_calls(20), [](const call_sequence& c) { return approaches(c.back()); });
  REQUIRE(small.size() == 1);
  const call_inputs& only = small[0];
  CHECK(approaches(only));
  CHECK(only.dd == std::vector{0.0});
  CHECK(only.dtest == std::vector{1.0});
  CHECK((only.dof.indof == 1 && only.dof.ndofpn == 1));
  REQUIRE(only.cc.size() == 1);
  CHECK(std::abs(only.cc[0] * 10 - std::round(only.cc[0] * 10)) < 1e-12);  // one digit
  CHECK(only.isurf[0] == face_above);
}

TEST_CASE("if a difference needs one earlier call, shrinking leaves two calls") {
  const call_sequence small = shrink(some_calls(30), [](const call_sequence& c) {
    return std::any_of(c.begin(), c.end() - 1, [](const auto& in) { return in.pairs() >= 3; }) &&
           approaches(c.back());
  });
  REQUIRE(small.size() == 2);
  CHECK(small[0].pairs() == 3);
  CHECK(small[1].pairs() == 1);
}

TEST_CASE("shrinking stops after the allowed number of tries, and the remaining calls still differ") {
  int tries = 0;
  const still_differs differs = [&tries](const call_sequence& c) {
    ++tries;
    return approaches(c.back());
  };
  CHECK(approaches(shrink(some_calls(20), differs, 5).back()));
  CHECK(tries == 5);
}

TEST_CASE("a mismatch is reproduced with new kernels, and the shrunk case has the leader's answers") {
  const auto leader = make_kernel("fortran");
  int made = 0;
  const fresh_kernel equal = [] { return make_kernel("cpp"); };
  const fresh_kernel in_single_precision = [&made] { return ++made, make_kernel("cpp-r4"); };
  const call_sequence calls = some_calls(3);
  CHECK_FALSE(shrunk_case(*leader, equal, calls, ""));
  const auto found = reproduce(*leader, *in_single_precision(), calls, "");
  REQUIRE(found);
  CHECK(found->what.call == 3);
  CHECK(found->what.follower == "cpp-r4");
  REQUIRE(found->calls.size() == 3);
  CHECK(found->calls[2].out.ss.size() == calls[2].pairs());
  CHECK_FALSE(reproduce(*leader, *in_single_precision(), calls, "no such field"));
  const auto small = shrunk_case(*leader, in_single_precision, calls, found->what.where.field);
  REQUIRE(small);
  CHECK(small->calls.size() == 1);
  CHECK(small->what.where.field == found->what.where.field);
  CHECK(made < 20);  // one for each change that is kept, not for each try
}
