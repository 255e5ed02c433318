// Campaigns on calls and on whole problems: what they count, and what they say of a follower that differs.
#include "contct/lab/call_campaign.hpp"

#include <cmath>
#include <stdexcept>

#include "catch.hpp"
#include "contct/lab/problem_campaign.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;

namespace {

/// An answered call with one pair at its face and one a unit away.
struct two_toggles {
  std::vector<double> dd = {0.0, 0.0}, dtest = {1.0, 1.0}, cc = {1e-11, 1.0}, ss = {0.5, 0.5};
  std::vector<int> id = {1, 2}, before = {in_contact, separated}, after = {separated, in_contact},
                   isurf = {1, 1};
  call<double> c{dd, dtest, cc, ss, 0.5, id, after, isurf, {}};
};

}  // namespace

TEST_CASE("shards together compare the calls of the whole run") {
  std::vector<branch_counts> counts;
  std::vector<std::int64_t> calls;
  for (const std::uint64_t stride : {1, 3}) {
    counts.emplace_back();
    calls.push_back(0);
    for (std::uint64_t shard = 1; shard <= stride; ++shard) {
      call_campaign h("fortran", {"cpp"}, 5);
      h.run(shard, 3000, stride);
      counts.back().add(h.counts().branches);
      calls.back() += h.counts().calls;
      CHECK(h.results()[0].compared.mismatches == 0);
      CHECK(h.results()[0].compared.values > 3 * h.counts().calls);
    }
  }
  CHECK(calls == std::vector<std::int64_t>{3000, 3000});
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true})
      CHECK(counts[0].of(static_cast<branch>(b), outcome) == counts[1].of(static_cast<branch>(b), outcome));
  }
}

TEST_CASE("a campaign refuses kernels that cannot be equal") {
  CHECK_THROWS_AS(call_campaign("fortran", {"corrected"}, 1), std::invalid_argument);
  CHECK_THROWS_AS(call_campaign("fortran", {"cpp-r4"}, 1), std::invalid_argument);
  CHECK_THROWS_AS(call_campaign("fortran", {"nobody"}, 1), std::invalid_argument);
}

TEST_CASE("events are counted by kind, and those of pairs within EPSGAP of their face as stationary") {
  two_toggles t;
  campaign_counts counts;
  counts.count(t.c, t.before);
  CHECK(counts.calls == 1);
  CHECK(counts.events.make == 1);
  CHECK(counts.events.break_ == 1);
  CHECK(counts.events.stationary == 1);
  counts.count(t.c, t.after);  // nothing toggled
  counts.add(campaign_counts(counts));
  CHECK(counts.calls == 4);
  CHECK(counts.events.make == 2);
  CHECK(counts.events.break_ == 2);
  CHECK(counts.events.stationary == 2);
  CHECK(counts.branches.of(branch::stationary, true) == 4);
}

TEST_CASE("how near a follower came is the largest distance, and whether its events were the same") {
  const call_inputs<double> in{{0.0}, {1.0}, {0.5}, {1}, {separated}, {face_above}, {}};
  call_outputs out;
  call<double> led = out.prepare(in);
  led.smin = std::nextafter(0.5, 1.0);
  led.ss[0] = std::nextafter(led.smin, 1.0);
  led.isep[0] = in_contact;
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  REQUIRE(f.ask(1, led, in.isep, std::nullopt));
  follower_result r;
  r.note_difference(led, f);
  CHECK(r.most_ulps == 2);
  CHECK(r.same_events);
  CHECK(r.always_answered);
  led.isep[0] = separated;
  (void)f.ask(2, led, in.isep, std::nullopt);
  r.note_difference(led, f);
  CHECK_FALSE(r.same_events);
  follower_result all;
  all.compared = {10, 0};
  r.compared = {5, 2};
  r.first = f.first();
  all.add(r);
  CHECK(all.compared.values == 15);
  CHECK(all.compared.mismatches == 2);
  CHECK(all.most_ulps == 2);
  CHECK_FALSE(all.same_events);
  REQUIRE(all.first);
  CHECK(all.first->call == 1);
}

TEST_CASE("a problem in lockstep has every call of its path compared, and is the same every time") {
  const problem_in_lockstep p = follow_in_lockstep(7, 3, "fortran", {"cpp"});
  CHECK(p.calls > 1);
  REQUIRE(p.each.size() == 1);
  CHECK(p.each[0].compared.mismatches == 0);
  CHECK(p.each[0].compared.values >= 4 * p.calls);
  CHECK_FALSE(p.each[0].first);
  CHECK(p.each[0].calls.empty());
  const problem_in_lockstep again = follow_in_lockstep(7, 3, "fortran", {"cpp"});
  CHECK(again.calls == p.calls);
  CHECK(again.events.make == p.events.make);
  CHECK(certified_as_leader(7, 3, "corrected", "corrected"));
}
