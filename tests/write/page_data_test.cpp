// What the page of a run draws from.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/run_page.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

TEST_CASE("the numbers of the page are the run's, with every digit") {
  const a_run r(good_problem);
  const nlohmann::json data = page_data(r.finished());
  REQUIRE(data["frames"].size() == 3);
  const nlohmann::json& end = data["frames"][2];
  const std::vector<double>& u = r.kept.frames().back().displacement;
  CHECK(end["w"] == std::vector<double>{u[0], u[2], u[4]});
  CHECK(end["slope"] == std::vector<double>{u[1], u[3], u[5]});
  CHECK(end["looks"] == "c");
  CHECK(end["counts"] == std::vector<int>{0, 1, 0});
  CHECK(end["end"] == true);
  CHECK(data["frames"][1]["events"] == nlohmann::json({{1, 3, -1, 1}}));
  CHECK(data["frames"][1]["looks"] == "f");
  CHECK(data["thinned"].empty());
}

TEST_CASE("moment and shear are the elements', on either side of a node, and nothing beyond the ends") {
  const a_run r(good_problem);
  const nlohmann::json data = page_data(r.finished());
  const nlohmann::json& end = data["frames"][2];
  // 60 down and the stop's force up, at the tip: the shear is the same all along, the moment falls to 0.
  const double tip = 60.0 - 5e4 * (-0.004 - r.kept.frames().back().displacement[4]);
  CHECK(end["shear"]["right"][0].get<double>() == Approx(tip));
  CHECK(end["shear"]["left"][2].get<double>() == Approx(tip));
  CHECK(end["moment"]["right"][0].get<double>() == Approx(-2 * tip));
  CHECK(end["moment"]["left"][1].get<double>() == Approx(-tip));
  CHECK(end["moment"]["right"][1].get<double>() == Approx(-tip));
  CHECK(end["moment"]["left"][0].is_null());
  CHECK(end["moment"]["right"][2].is_null());
  CHECK(end["moment"]["largest"].get<double>() == Approx(-2 * tip));
  CHECK(end["moment"]["node"] == 1);
}

TEST_CASE("every call has its distance from each follower's answer") {
  const a_run r(good_problem);
  const nlohmann::json data = page_data(r.finished());
  REQUIRE(data["calls"].size() == 2);
  for (const auto& call : data["calls"]) CHECK(call["followers"] == nlohmann::json({{4, 0, 0, 0, 0}}));
  CHECK(data["calls"][0]["smin"] == r.record.calls[0].smin);
  CHECK(r.record.calls[0].smin == Approx(0.25));
  CHECK(data["calls"][0]["ss"] == std::vector<double>{r.record.calls[0].smin});
  CHECK(data["calls"][1]["number"] == 2);
  CHECK_THAT(data["log"].get<std::string>(), Contains("MAKING CONTACT"));
}

TEST_CASE("a plate's frame has w at the crossings of its grid lines, row by row") {
  const a_run r(good_plate);
  const nlohmann::json data = page_data(r.finished());
  CHECK(data["geometry"]["kind"] == "plate");
  CHECK(data["geometry"]["x"].size() * data["geometry"]["y"].size() == 6);
  const std::vector<double>& u = r.kept.frames().back().displacement;
  CHECK(data["frames"].back()["w"] == std::vector<double>{u[0], u[3], u[6], u[9], u[12], u[15]});
}
