// The result of a fuzz run as JSON, and the results of shards added up.
#include "contct/lab/fuzz_json.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/text/input_text.hpp"
#include "support/scratch_folder.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

fuzz_result shard(int number, equality_level highest) {
  fuzz_result r;
  r.request.shard = number;
  r.request.shards = 2;
  r.calls = 100 * number;
  r.problems = number;
  r.seconds = 0.5;
  r.events = {1, 2, 3};
  r.branches.add(branch::no_events, true, 7);
  r.followers.push_back(
      {"cpp", {1000 * number, number - 1}, highest, 5U * static_cast<unsigned>(number), {}});
  if (number == 2) r.followers[0].mismatch_reports = {"call 3: cpp differs"};
  return r;
}

}  // namespace

TEST_CASE("the JSON of a run has its counts, its request and each follower's level") {
  const auto j = nlohmann::json::parse(fuzz_json(shard(2, equality_level::events)));
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
}

TEST_CASE("shards are added up, and the lowest level and the first mismatch are kept") {
  const scratch_folder folder;
  const std::string one = folder.write("1.json", fuzz_json(shard(1, equality_level::bits)));
  const std::string two = folder.write("2.json", fuzz_json(shard(2, equality_level::certificate)));
  const fuzz_result all = merged_fuzz({two, one});
  CHECK(all.calls == 300);
  CHECK(all.problems == 3);
  CHECK(all.seconds == 1.0);
  CHECK(all.events.stationary == 6);
  CHECK(all.branches.of(branch::no_events, true) == 14);
  CHECK(all.compared().values == 3000);
  CHECK(all.compared().mismatches == 1);
  REQUIRE(all.followers.size() == 1);
  CHECK(all.followers[0].highest == equality_level::certificate);
  CHECK(all.followers[0].most_ulps == 10);
  CHECK(all.followers[0].mismatch_reports == std::vector<std::string>{"call 3: cpp differs"});
  CHECK(all.request.shards == 1);
}

TEST_CASE("every level is written and read back") {
  for (int level = 0; level < equality_levels; ++level) {
    const scratch_folder folder;
    fuzz_result r = shard(1, static_cast<equality_level>(level));
    r.request.shards = 1;
    CHECK(merged_fuzz({folder.write("r.json", fuzz_json(r))}).followers[0].highest ==
          static_cast<equality_level>(level));
  }
}

TEST_CASE("shards that are missing, given twice, of another run or no results are refused") {
  const scratch_folder folder;
  const std::string one = folder.write("1.json", fuzz_json(shard(1, equality_level::bits)));
  fuzz_result other = shard(2, equality_level::bits);
  other.request.seed = 7;
  CHECK_THROWS_WITH(merged_fuzz({one}), Contains("1 of 2 shards"));
  CHECK_THROWS_WITH(merged_fuzz({one, one}), Contains("found shard 1 once more"));
  CHECK_THROWS_WITH(merged_fuzz({one, folder.write("2.json", fuzz_json(other))}), Contains("another run"));
  CHECK_THROWS_AS(merged_fuzz({folder.write("empty.json", "{}")}), input_error);
  CHECK_THROWS_AS(merged_fuzz({folder.write("other.json", "{\"format\": \"another\"}")}), input_error);
}
