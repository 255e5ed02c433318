// The result of a fuzz run as JSON, and a found case as a trace.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/lab/fuzz.hpp"
#include "contct/lab/random_calls.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

fuzz_result a_shard() {
  fuzz_result r;
  r.request.shard = 2;
  r.request.shards = 2;
  r.calls = 200;
  r.problems = 2;
  r.events = {1, 2, 3};
  r.branches.of(branch::no_events, true) += 7;
  fuzz_follower& f = r.followers.emplace_back();
  f.name = "cpp";
  f.compared = {2000, 1};
  f.highest = equality_level::events;
  f.most_ulps = 10;
  f.mismatch_reports = {"call 3: cpp differs"};
  return r;
}

/// A case of one adversarial call with a few pairs.
found_case a_case() {
  call_source source(1989, 8);
  std::uint64_t number = 2;
  while (source.at(number).pairs() < 3) number += 2;
  found_case c;
  c.what = {1, "fortran", "mine", {"SS", 1, "0x1p+0", "0x1p-1", 1}, {}};
  c.calls = {source.at(number)};
  c.leader.resize(1);
  c.leader[0].smin = 0.5;
  c.leader[0].ss.assign(c.calls[0].pairs(), 0.5);
  c.leader[0].isep = c.calls[0].isep;
  return c;
}

}  // namespace

TEST_CASE("the JSON of a run has its counts, its request and each follower's level") {
  const auto j = nlohmann::json::parse(fuzz_json(a_shard()));
  CHECK(j["format"] == "contct-fuzz-1");
  CHECK(j["kernels"] == std::vector<std::string>{"fortran", "cpp"});
  CHECK(j["calls"] == 200);
  CHECK(j["values_compared"] == 2000);
  CHECK(j["mismatches"] == 1);
  CHECK(j["events"]["break"] == 2);
  CHECK(j["branches"]["no_events_true"] == 7);
  CHECK(j["branches"].size() == 16);
  CHECK(j["asked"]["calls"] == 200'000);
  CHECK(j["shard"]["of"] == 2);
  CHECK(j["followers"][0]["rung"] == "events");
  CHECK(j["followers"][0]["most_ulps"] == 10);
  CHECK(j["followers"][0]["findings"] == std::vector<std::string>{"call 3: cpp differs"});
}

TEST_CASE("a case as a trace is read back, and says what differed") {
  const found_case c = a_case();
  const std::string text = trace_of(c, {});
  trace_reader reader(text, "a case");
  const trace_header h = reader.read_header();
  REQUIRE_FALSE(h.about.empty());
  CHECK(h.about[0] == "call 1: mine differs in SS(1): fortran has 0x1p+0, mine has 0x1p-1 (1 ULP)");
  recorded_call read;
  REQUIRE(reader.next(read));
  CHECK(read.in.id == c.calls[0].id);
  CHECK(read.out.ss == c.leader[0].ss);
  CHECK_FALSE(reader.next(read));
}
