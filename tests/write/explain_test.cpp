// Tests the sentences, text and JSON of an explained run. tests/app/explain_test.cpp tests whole texts of the
// program.
#include "contct/write/explain.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Explains a path of FORTRAN with C++ as the second kernel. Passes each increment to `first`, if given, and
/// then to `sink`. Returns the path, which has the totals.
explained_path explain_run(const problem& p, explained_path::sink sink, observer* first = nullptr) {
  const auto leader = make_kernel("fortran");
  const std::string second[] = {"cpp"};
  explained_path path(leader->facts(), second, {}, std::move(sink));
  std::vector<observer*> watching = {&path};
  if (first != nullptr) watching.insert(watching.begin(), first);
  follow(p, structure_of(p), "refactor", *leader, watching);
  return path;
}

/// A cantilever whose tip reaches its stop at a quarter of the load, with another pair at the clamped node.
const char* const two_pairs =
    "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.25\nstiffness = 1\n"
    "[[contact]]\nnode = 1\nsurface = \"below\"\nface = -1\nstiffness = 1\n"
    "[[step]]\npoint = [ { node = 2, w = -3 } ]\n";

/// Returns the lines of the listing that a story cites, with 0 for a sentence without a line.
std::vector<int> lines_of(const nlohmann::json& story) {
  std::vector<int> lines;
  for (const auto& sentence : story) lines.push_back(sentence.value("line", 0));
  return lines;
}

std::string explained_text(const problem& p, int pair, int width, bool all = true) {
  explain_text text({p, {"fortran", "cpp"}, 8, pair}, {width, false}, all);
  std::string told;
  explain_run(p, [&](const explained_increment& i) { told += text.add(i); });
  return told + text.finish();
}

std::string explained_text(int pair, int width, const std::string& toml = two_pairs, bool all = true) {
  return explained_text(parse_problem(toml, "pb.toml"), pair, width, all);
}

/// Returns `two_pairs` with `steps` more steps, each with one increment and no event.
std::string two_pairs_and(int steps) {
  std::string toml = two_pairs;
  for (int i = 0; i < steps; ++i) toml += "[[step]]\npoint = [ { node = 2, w = -3 } ]\n";
  return toml;
}

nlohmann::json explained_json(const std::string& text, int pair = 0) {
  const problem p = parse_problem(text, "pb.toml");
  std::string written;
  output_file out(&written);
  explain_json json({p, {"fortran", "cpp"}, 8, pair}, out);
  json.finish("solved", explain_run(p, [&](const explained_increment& i) { json.write(i); }));
  return nlohmann::json::parse(written);
}

}  // namespace

TEST_CASE(
    "the explanation of a pair cites the lines of the listing that the pair took, and the paper's "
    "equations") {
  const nlohmann::json calls = explained_json(two_pairs)["increments"];
  REQUIRE(calls.size() == 2);
  const nlohmann::json& pairs = calls[0]["pairs"];
  CHECK(lines_of(pairs[0]["story"]) == std::vector<int>{30, 31, 33, 38, 40, 51, 52, 54, 55});
  CHECK(pairs[0]["story"][3]["equation"] == "(4)");
  CHECK(lines_of(pairs[1]["story"]) == std::vector<int>{30, 31, 32, 40, 51, 52});
  CHECK(lines_of(calls[0]["story"]) == std::vector<int>{42, 0});
  CHECK(lines_of(calls[1]["story"]) == std::vector<int>{42, 45});
  CHECK(calls[1]["pairs"][0]["kind"] == "stationary");
  CHECK(pairs[0]["why"] == "winner");
  CHECK(pairs[1]["why"] == "not toggled");
}

TEST_CASE(
    "numbers of two kernels are described as equal to the bit, as some ULPs apart, or as different if one is "
    "NaN") {
  const double next = std::nextafter(0.25, 1.0);
  const problem p = parse_problem(two_pairs, "pb.toml");
  const explained_kernels of{p, {"a", "b"}, 8, 0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(side_by_side_words(of, 0.25, 0.25) == "a and b are equal to the bit");
  CHECK(side_by_side_words(of, 0.25, next) == "a and b are 1 ULP apart");
  CHECK(side_by_side_words(of, 0.25, nan) == "a and b are different: one is NaN");
  CHECK(ulps_apart(0.25, next, 8) == 1);
  CHECK(ulps_apart(0.25, std::nextafter(0.25F, 1.0F), 4) == 1);
}

TEST_CASE("contct explain prints one line for each of more than 20 increments, unless --all is given") {
  const std::string few = explained_text(0, 80, two_pairs_and(18), false);
  CHECK(few == explained_text(0, 80, two_pairs_and(18)));
  CHECK_THAT(few, Contains("Step 19, increment 1\n"));
  const std::string many = explained_text(0, 80, two_pairs_and(19), false);
  CHECK_THAT(
      many,
      StartsWith("  incr  share      events\n   1.1  0.25       make 1\n   1.2  1          no event\n") &&
          Contains("\n  20.1  1          no event\n\n21 increments") && Contains("--all") &&
          !Contains("Step"));
  CHECK_THAT(explained_text(0, 80, two_pairs_and(19)),
             Contains("Step 20, increment 1\n") && !Contains("--all"));
}

TEST_CASE(
    "the short explanation of a run names early toggles, and shortens a list of more than twelve events") {
  std::string toml = "title = \"Stops\"\n" + two_pairs_and(20);
  const std::string stop = "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.25\nstiffness = 1\n";
  for (int i = 0; i < 13; ++i) toml += stop;
  toml += "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.2501\nstiffness = 1\n";
  const std::string text = explained_text(0, 60, toml, false);
  CHECK_THAT(text, StartsWith("Stops\n  incr  share      events\n   1.1  0.25       make 1, make 3"));
  CHECK_THAT(text, Contains("\n                   make 7") && Contains("make 13, 3 more; too early: 16\n"));
}

TEST_CASE(
    "the JSON explanation of an increment has s, the load, the winner, and each pair with its branches") {
  const nlohmann::json j = explained_json(two_pairs);
  CHECK(j["format"] == "contct-explain-1");
  CHECK(j["real_bytes"] == 8);
  CHECK(j["kernels"] == nlohmann::json({"fortran", "cpp"}));
  REQUIRE(j["increments"].size() == 2);
  const nlohmann::json& first = j["increments"][0];
  CHECK(first["s"].get<double>() == Approx(0.25));  // d* = -1, and the gap is 0.25
  CHECK(first["load"]["force"].get<double>() == Approx(-0.75));
  CHECK(first["winner"]["pair"] == 1);
  CHECK_FALSE(first.contains("apart"));
  for (const char* key : {"if", "outcome", "ulps"}) CHECK(first["narrowest"].contains(key));
  REQUIRE(first["pairs"].size() == 2);
  const nlohmann::json& stop = first["pairs"][0];
  CHECK(stop["before"] == "separated");
  CHECK(stop["after"] == "contact");
  CHECK(stop["why"] == "winner");
  CHECK(stop["bits"]["ulps"] == 0);
  CHECK(stop["bits"]["fortran"] == stop["bits"]["cpp"]);
  CHECK(stop["branches"][0]["if"] == "DTEST(NDOF).EQ.0.");
  CHECK(stop["branches"][0]["outcome"] == false);
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

TEST_CASE("if one pair is requested, every increment in the explanation has only this pair") {
  const nlohmann::json j = explained_json(two_pairs, 2);
  for (const auto& i : j["increments"]) {
    REQUIRE(i["pairs"].size() == 1);
    CHECK(i["pairs"][0]["pair"] == 2);
  }
}

TEST_CASE(
    "the explanation says if a pair reaches its face exactly at full load, which is no event for the "
    "listing") {
  // The face is exactly where the tip is at full load.
  problem p = parse_problem(two_pairs, "pb.toml");
  p.pairs[0].face = -10.0;
  std::vector<double> end;
  struct last_end final : observer {
    explicit last_end(std::vector<double>& u) : u_(u) {}
    void called(const answered_call& c) override { u_.assign(c.c.dtest.begin(), c.c.dtest.end()); }
    std::vector<double>& u_;
  } keeps(end);
  (void)explain_run(
      p, [](const explained_increment&) {}, &keeps);
  p.pairs[0].face = end.at(2);
  CHECK_THAT(explained_text(p, 0, 100),
             Contains("Exactly at the full load: the listing treats this as no event."));
  CHECK_THAT(explained_text(0, 100), !Contains("Exactly at the full load"));
}

TEST_CASE(
    "if two kernels differ, the explanation gives the second kernel's value, or its whole line of text") {
  const problem p = parse_problem(two_pairs, "pb.toml");
  const auto told = [&](const mismatch& apart) {
    std::string written;
    output_file out(&written);
    explain_json json({p, {"fortran", "cpp"}, 8, 0}, out);
    std::string text;
    explained_path path = explain_run(p, [&](explained_increment i) {
      i.apart = apart;
      json.write(i);
      text += explain_text({p, {"fortran", "cpp"}, 8, 0}, {100, false}).add(i);
    });
    json.finish("solved", path);
    return std::pair(text, nlohmann::json::parse(written)["increments"][0]["apart"]);
  };
  const auto [of_text, text_apart] = told({"text", 3, "one", "two", 0});
  CHECK_THAT(of_text, Contains(R"(Unit 26, line 3: fortran wrote "one", cpp wrote "two")"));
  CHECK(text_apart == nlohmann::json({{"field", "text"}, {"index", 3}, {"fortran", "one"}, {"cpp", "two"}}));
  const auto [of_smin, smin_apart] = told({"SMIN", 0, "0x1p-2", "0x1p-1", 5});
  CHECK_THAT(of_smin, !Contains("Unit 26, line"));
  CHECK(smin_apart ==
        nlohmann::json({{"field", "SMIN"}, {"index", 0}, {"fortran", "0x1p-2"}, {"cpp", "0x1p-1"}}));
}
