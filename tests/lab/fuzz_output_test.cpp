// The result of a fuzz run as JSON, the results of shards added up, and a found case as files.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/lab/fuzz.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/text/input_text.hpp"
#include "support/scratch_folder.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

fuzz_result shard(int number, equality_level highest) {
  fuzz_result r;
  r.request.shard = number;
  r.request.shards = 2;
  r.calls = 100L * number;
  r.problems = number;
  r.seconds = 0.5;
  r.events = {1, 2, 3};
  r.branches.of(branch::no_events, true) += 7;
  fuzz_follower& f = r.followers.emplace_back();
  f.name = "cpp";
  f.compared = {1000L * number, number - 1};
  f.highest = highest;
  f.most_ulps = 5UL * static_cast<unsigned>(number);
  if (number == 2) r.followers[0].mismatch_reports = {"call 3: cpp differs"};
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
  for (const char* number : {"2.5e22", "1.5", "18446744073709551615", "4294967297"}) {
    INFO(number);
    auto j = nlohmann::json::parse(fuzz_json(shard(1, equality_level::bits)));
    j["shard"]["of"] = nlohmann::json::parse(number);
    CHECK_THROWS_WITH(
        merged_fuzz({folder.write("no_shard.json", j.dump())}),
        Contains("no_shard.json: found no fuzz result: /shard/of: ") && Contains("; allowed: whole numbers"));
  }
  CHECK_THROWS_AS(merged_fuzz({folder.write("other.json", "{\"format\": \"another\"}")}), input_error);
}

TEST_CASE("the refusal of what is no JSON quotes a little of it") {
  const scratch_folder folder;
  const std::string long_text = "{\"format\": \"" + std::string(5000, 'x');
  const Catch::Matchers::Generic::PredicateMatcher<std::string> short_text(
      [](const std::string& message) { return message.size() < 1000; }, "is short");
  CHECK_THROWS_WITH(merged_fuzz({folder.write("cut.json", long_text)}),
                    Contains("cut.json: found no fuzz result: ") && short_text);
}

TEST_CASE("a case as a FORTRAN main program fits its columns, and its literals are read back exactly") {
  const std::string main = fortran_main_of(a_case());
  std::size_t from = 0;
  int lines = 0;
  for (std::size_t to = 0; (to = main.find('\n', from)) != std::string::npos; from = to + 1, ++lines) {
    INFO(main.substr(from, to - from));
    CHECK(to - from <= 72);
  }
  CHECK(lines > 10);
  CHECK_THAT(main, Contains("CALL CONTCT (DD, DTEST, CC, SS, SMIN, ID, ISEP, ISURF, "));
}

TEST_CASE("what no FORTRAN literal can say is computed from zero") {
  found_case c = a_case();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  c.calls[0].cc = {0.0, -0.0, std::nan("")};
  c.calls[0].dd[c.calls[0].dof_of_pair(0)] = -infinity;
  for (auto* list : {&c.calls[0].id, &c.calls[0].isep, &c.calls[0].isurf}) list->resize(3);
  const std::string main = fortran_main_of(c);
  CHECK_THAT(main, Contains("      CC(1) = 0.\n") && Contains("      CC(2) = -Z\n") &&
                       Contains("      CC(3) = Z / Z\n"));
  CHECK_THAT(main, Contains(" = -1. / Z\n"));
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

TEST_CASE("a case as a Catch2 test asks the follower and expects the leader's numbers") {
  found_case c = a_case();
  c.what.follower = "plugin:\"./mine\".so";
  const std::string test = catch_test_of(c);
  CHECK_THAT(test, Contains("TEST_CASE(\"plugin    mine  so answers as fortran does\")"));
  CHECK_THAT(test, Contains("make_kernel(\"plugin:\\\"./mine\\\".so\")"));
  CHECK_THAT(test, Contains("CHECK(contct::outside::same_bits(asked.smin, 0x1p-1));"));
  CHECK_THAT(test, Contains("CHECK(contct::outside::same_bits(out.ss[2], 0x1p-1));"));
}

TEST_CASE("a checkpoint is read as it was written, and refused where its counts do not fit") {
  const scratch_folder folder;
  fuzz_checkpoint c;
  c.result = shard(2, equality_level::bits);
  c.result.followers[0].same_events = false;
  c.calls_up_to = 20;
  c.problems_up_to = 4;
  c.result.problems = 2;
  c.differing_problems = {2};
  c.firsts = {{2, 17}};
  const std::string file = folder.write("c.json", checkpoint_json(c));
  const fuzz_checkpoint read = checkpoint_from(file, c.result.request);
  CHECK(checkpoint_json(read) == checkpoint_json(c));
  CHECK_FALSE(read.result.followers[0].same_events);
  CHECK(read.result.followers[0].always_answered);
  CHECK(read.firsts[0].call == 17);

  fuzz_request other = c.result.request;
  other.seed = 7;
  CHECK_THROWS_WITH(checkpoint_from(file, other), Contains("the checkpoint of another run"));
  const auto refused = [&](const char* key, const nlohmann::json& value) {
    auto j = nlohmann::json::parse(checkpoint_json(c));
    j[nlohmann::json::json_pointer(key)] = value;
    const std::string doctored = folder.write("doctored.json", j.dump());
    INFO(key << ": " << value);
    CHECK_THROWS_AS(checkpoint_from(doctored, c.result.request), input_error);
  };
  refused("/format", "contct-fuzz-1");
  refused("/calls_up_to", -1);
  refused("/calls_up_to", 300'000);
  refused("/calls_up_to", 199'999);  // with fewer calls in the result
  refused("/problems_up_to", 6);
  refused("/problems_up_to", 1000);
  refused("/first/0/problem", 5);
  refused("/first/0/call", -3);
  refused("/first", nlohmann::json::array());
  refused("/differing_problems", {2.0});
  refused("/differing_problems/0", 1e300);
  refused("/result/followers", nlohmann::json::array());
  const std::string text = checkpoint_json(c);
  const std::string cut = folder.write("cut.json", text.substr(0, text.size() / 2));
  CHECK_THROWS_WITH(checkpoint_from(cut, c.result.request), Contains("found no checkpoint"));
}
