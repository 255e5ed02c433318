// The exact numbers of an explanation. Whole texts are tested on the program: tests/app/explain_test.cpp.
#include "contct/write/explain_exact.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/exact/exact_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "support/scratch_folder.hpp"
#include "write/explained_run.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// A call with one open pair above a face below it.
explained_call one_pair(double c, double d, double d_star, double s) {
  explained_call call;
  explained_pair p;
  p.c = c;
  p.d = d;
  p.d_star = d_star;
  p.s = s;
  p.way = way_to_s::moving;
  call.pairs = {p};
  return call;
}

nlohmann::ordered_json explained_exactly(const std::string& text) {
  const problem p = parse_problem(text, "pb.toml");
  const exact_problem exactly = exact_problem_of(p);
  exact_companion beside(exactly);
  exact_addition more(&beside);
  const scratch_folder folder;
  output_file out(folder.at("x.json"));
  explain_json json({p, {"fortran", "cpp"}, 8, 0}, out);
  const explained_path path = explain_run(
      p,
      [&](const explained_increment& i) {
        more.begin(i);
        json.write(i, &more);
      },
      &beside);
  json.finish("solved", path);
  return nlohmann::ordered_json::parse(folder.read("x.json"));
}

}  // namespace

TEST_CASE("the exact answer is that of the doubles of the call, bit for bit") {
  const std::optional<listing_answer> a = answer_of(one_pair(-0.1, 0.0, -0.3, 0.1 / 0.3));
  REQUIRE(a.has_value());
  CHECK(a->s[0] == binary_value(0.1) / binary_value(0.3));
  CHECK(a->s[0] != rational(1, 3));
  CHECK(a->toggled == std::vector<int>{0});
}

TEST_CASE("a call with a number that is not finite has no exact answer") {
  for (const double x : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_FALSE(answer_of(one_pair(x, 0.0, -0.3, 0.5)).has_value());
    CHECK_FALSE(answer_of(one_pair(-0.1, x, -0.3, 0.5)).has_value());
    CHECK_FALSE(answer_of(one_pair(-0.1, 0.0, x, 0.5)).has_value());
  }
}

TEST_CASE("increments and pairs have their exact numbers, and the errors of both kernels") {
  const nlohmann::ordered_json j = explained_exactly(two_pairs);
  REQUIRE(j["increments"].size() == 2);
  const auto& first = j["increments"][0];
  CHECK(first["exact_path"]["smin"] == "1/4");
  CHECK(first["exact_path"]["fraction"] == "1/4");
  CHECK(first["exact_path"]["winners"] == nlohmann::ordered_json({1}));
  CHECK(first["exact_path"]["toggled"] == nlohmann::ordered_json({1}));
  CHECK_FALSE(first["exact_path"].contains("parted"));
  CHECK(first["exact"]["toggled"] == nlohmann::ordered_json({1}));
  const auto& stop = first["pairs"][0];
  CHECK(stop["exact_path"]["s"] == "1/4");
  CHECK(stop["exact_path"]["kind"] == "advancing");
  for (const char* kernel : {"fortran", "cpp"}) {
    CHECK(std::abs(stop["exact"]["ulps_off"][kernel].get<double>()) <= 0.5);  // one division, of exact parts
    CHECK(first["exact"]["ulps_off"][kernel] == stop["exact"]["ulps_off"][kernel]);
  }
  CHECK(first["pairs"][1]["exact"]["kind"] == "no response");
  CHECK(first["pairs"][1]["exact_path"]["s"] == "1");
  CHECK(j["increments"][1]["exact"]["winners"].empty());
}

TEST_CASE("an exact path that is not followed says why") {
  const problem p = parse_problem(two_pairs, "pb.toml");
  const explained_kernels of{p, {"fortran"}, 8, 0};
  exact_addition more(nullptr, "too many dofs");
  const explained_call call = one_pair(-0.1, 0.0, -0.3, std::nan(""));
  const explained_increment i{{1, 1, 1.0, 1.0, {}}, 0.0, call, nullptr, {}, false};
  more.begin(i);
  CHECK_THAT(more.of_end(of, i)[0].words, Contains("is not followed: too many dofs"));
  CHECK(more.of_s(of, i, call.pairs[0]).size() == 1);
  CHECK_THAT(more.of_s(of, i, call.pairs[0])[0].words, Contains("; fortran nan."));
  nlohmann::ordered_json out;
  more.put_pair(out, of, i, call.pairs[0]);
  CHECK(out["exact"]["ulps_off"]["fortran"].is_null());
  CHECK(out["exact_path"].is_null());
  more.put_increment(out, of, i);
  CHECK(out["exact_path"]["stopped"] == "too many dofs");
}
