// An explained run as JSON: reference/explain-format.md.
#include "contct/write/explain_json.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "support/scratch_folder.hpp"
#include "write/explained_run.hpp"

using namespace contct::app;

namespace {

nlohmann::json explained(const std::string& text, int pair = 0) {
  const problem p = parse_problem(text, "pb.toml");
  const scratch_folder folder;
  output_file out(folder.at("x.json"));
  explain_json json(p, {"fortran", "cpp"}, 8, pair, out);
  const explained_path path = explain_run(p, [&](const explained_increment& i) { json.write(i); });
  json.finish("solved", path);
  return nlohmann::json::parse(folder.read("x.json"));
}

}  // namespace

TEST_CASE("each increment has its numbers, the winner and every pair with the reasons") {
  const nlohmann::json j = explained(two_pairs);
  CHECK(j["format"] == "contct-explain-1");
  CHECK(j["real_bytes"] == 8);
  CHECK(j["kernels"] == nlohmann::json({"fortran", "cpp"}));
  REQUIRE(j["increments"].size() == 2);
  const nlohmann::json& first = j["increments"][0];
  CHECK(first["s"].get<double>() == Approx(0.25));  // d* = -1 at the tip: the gap is a quarter of it
  CHECK(first["load"]["force"].get<double>() == Approx(-0.75));
  CHECK(first["winner"]["pair"] == 1);
  CHECK_FALSE(first.contains("apart"));
  REQUIRE(first["pairs"].size() == 2);
  const nlohmann::json& stop = first["pairs"][0];
  CHECK(stop["before"] == "separated");
  CHECK(stop["after"] == "contact");
  CHECK(stop["why"] == "winner");
  CHECK(stop["bits"]["ulps"] == 0);
  CHECK(stop["bits"]["fortran"] == stop["bits"]["cpp"]);
  CHECK(stop["story"][0]["line"] == 30);
  const nlohmann::json& clamped = first["pairs"][1];
  CHECK(clamped["node"] == 1);
  CHECK(clamped["kind"] == "no response");
  CHECK(clamped["toggled"] == false);
  CHECK_FALSE(clamped.contains("distance_from_face"));
  CHECK(j["increments"][1]["winner"].is_null());
  CHECK(j["lockstep"]["mismatches"] == 0);
  CHECK(j["lockstep"]["calls"] == 2);
  CHECK(j["status"] == "solved");
}

TEST_CASE("one pair alone is written when it alone is wanted") {
  const nlohmann::json j = explained(two_pairs, 2);
  for (const auto& i : j["increments"]) {
    REQUIRE(i["pairs"].size() == 1);
    CHECK(i["pairs"][0]["pair"] == 2);
  }
}
