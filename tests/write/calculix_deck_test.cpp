// A deck for CalculiX avoids what CalculiX gets wrong; beams and plates in its quadratic elements.
#include "contct/write/calculix_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

const std::string beam_text =
    "[beam]\nx = [0, 1, 2]\nEI = [1e4, 2e4]\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5e4\n"
    "[[step]]\nuniform = -6\n[[step]]\npoint = [ { node = 3, w = -60 }, { node = 2, theta = 4 } ]\n";

const std::string plate_text =
    "[plate]\nsize = [2, 1]\nelements = [2, 1]\nD = 1\nnu = 0.3\n[[support]]\nnodes = [1, 4]\n"
    "fix = [\"w\", \"wx\", \"wy\"]\n[[step]]\nuniform = -6\n";

calculix_deck deck_of(const std::string& text, const calculix_choice& choice = {}) {
  return calculix_deck_of(parse_problem(text, "pb.toml"), choice);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

double total_of(const calculix_mesh& m, int direction) {
  double sum = 0.0;
  for (const auto& [at, value] : m.forces) sum += at.second == direction ? value : 0.0;
  return sum;
}

bool fixes(const calculix_mesh& m, int node, int direction) {
  return std::any_of(m.fixed.begin(), m.fixed.end(),
                     [&](const auto& f) { return f.node == node && f.direction == direction; });
}

}  // namespace

TEST_CASE("a deck has NLGEOM, nonlinear SPRINGA and no field of more than 20 characters") {
  for (const std::string& text : {beam_text, plate_text}) {
    const calculix_deck deck = deck_of(text);
    CHECK_THAT(deck.text, Contains("*STEP,NLGEOM\n"));
    for (const std::string& line : lines_of(deck.text)) {
      INFO(line);
      CHECK((line.compare(0, 2, "**") == 0 || line.size() <= 132));
      if (line[0] == '*') continue;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) CHECK(field.size() <= 20);
    }
  }
  CHECK_THAT(deck_of(beam_text).text, Contains("*ELEMENT,TYPE=SPRINGA") && Contains(",NONLINEAR\n"));
}

TEST_CASE("loads and faces are scaled so that the largest deflection is small, and the deck says by what") {
  const calculix_deck deck = deck_of(beam_text);
  CHECK(deck.step == 2);
  CHECK_THAT(deck.text, Contains("\n** displacement-scale "));
  // Tip: -0.004 and what the spring gives way; 2e-7 is 1e-7 of the length.
  CHECK(deck.displacement_scale < 2e-7 / 0.004);
  CHECK(deck.displacement_scale > 2e-7 / 0.008);
  const std::string face = fmt::format("0.,{:.12e}\n", -0.004 * deck.displacement_scale);
  CHECK_THAT(deck.text, Contains(face));
  CHECK(deck.force_scale == Catch::Detail::Approx(1e6 / 64));  // of 60 and 4
  CHECK(deck.first_ground == deck.nodes + 1);
}

TEST_CASE("what CalculiX cannot have is refused by name") {
  const auto with = [](std::string text, std::string_view from, std::string_view to) {
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK_THROWS_WITH(
      deck_of(with(beam_text, "fix = [\"w\", \"theta\"]", "fix = [\"w\"]\nspring = { theta = 3 }")),
      Contains("node 1 has a spring in theta"));
  CHECK_THROWS_WITH(deck_of(with(beam_text, "fix = [\"w\", \"theta\"]", "fix = [\"w\"]")),
                    Contains("do not hold the structure"));
  CHECK_THROWS_WITH(deck_of(with(plate_text, "nu = 0.3", "nu = 0.5")), Contains("plate.nu: found 0.5"));
  CHECK_THROWS_WITH(deck_of(beam_text, {3, 2, 500}), Contains("--step: found 3; allowed: 1 to 2"));
  // Without a load nothing is scaled, and E of a section that is 1/500 as thick is infinite.
  CHECK_THROWS_WITH(deck_of("[beam]\nlength = 1\nelements = 1\nEI = 1e300\n[[support]]\nnode = 1\n"
                            "fix = [\"w\", \"theta\"]\n[[step]]\nuniform = 0\n"),
                    Contains("found inf, scaled for CalculiX; allowed: numbers within the range"));
}

TEST_CASE("each of a beam's elements becomes as many as asked for, with a node at every middle") {
  const problem p = parse_problem(beam_text, "pb.toml");
  for (const int refine : {1, 2, 5}) {
    const calculix_mesh m = calculix_mesh_of(p, refine, 0);
    CHECK(m.elements.size() == static_cast<std::size_t>(2 * refine));
    CHECK(m.nodes.size() == static_cast<std::size_t>(4 * refine + 1));
    for (const auto& e : m.elements) CHECK(e.size() == 3);
    CHECK(std::abs(total_of(m, 3) + 12) < 1e-12);  // uniform: all of it arrives
    CHECK(m.nodes[2].x == 2.0);
  }
}

TEST_CASE("a beam's slope turns against CalculiX's axis") {
  const calculix_mesh m = calculix_mesh_of(parse_problem(beam_text, "pb.toml"), 1, 1);
  CHECK(m.forces.at({1, 5}) == -4.0);
  CHECK(m.forces.at({2, 3}) == -60.0);
  CHECK(fixes(m, 0, 5));
}

TEST_CASE("a plate's edge that is fixed at its nodes is fixed between them") {
  const calculix_mesh m = calculix_mesh_of(parse_problem(plate_text, "pb.toml"), 2, 0);
  CHECK(m.elements.size() == 8);
  CHECK(std::abs(total_of(m, 3) + 12) < 1e-12);
  int on_edge = 0;
  for (std::size_t i = 0; i < m.nodes.size(); ++i) {
    const bool edge = m.nodes[i].x == 0.0;
    on_edge += edge ? 1 : 0;
    for (const int direction : {3, 4, 5}) CHECK(fixes(m, static_cast<int>(i), direction) == edge);
  }
  CHECK(on_edge == 5);
}

TEST_CASE("a plate's nodes that are fixed in w alone are points: between them it is free") {
  std::string text = plate_text;
  text.replace(text.find("[\"w\", \"wx\", \"wy\"]"), 17, "[\"w\"]\n[[support]]\nnode = 3\nfix = [\"w\"]");
  const calculix_mesh m = calculix_mesh_of(parse_problem(text, "pb.toml"), 2, 0);
  int held = 0;
  for (const auto& f : m.fixed) held += f.direction == 3 ? 1 : 0;
  CHECK(held == 3);
}

TEST_CASE("A support that settles is moved in the step, a slope against CalculiX's axis") {
  const std::string settles =
      beam_text + "[[step]]\nsettlement = [ { node = 1, w = -0.002, theta = 0.5 } ]\n";
  const calculix_deck deck = deck_of(settles, {.step = 3});
  const auto lines = lines_of(deck.text);
  const auto step = std::find(lines.begin(), lines.end(), "*STATIC");
  REQUIRE(lines.end() - step > 4);
  CHECK(step[2] == "*BOUNDARY");
  CHECK(step[3] == fmt::format("1,3,3,{:.12e}", -0.002 * deck.displacement_scale));
  CHECK(step[4] == fmt::format("1,5,5,{:.12e}", -0.5 * deck.displacement_scale));
  CHECK(step[5] == "*CLOAD");
  CHECK_THAT(deck_of(settles, {.step = 2}).text, !Contains("1,3,3,"));
}

TEST_CASE("Between nodes of an edge that settles, a plate's edge follows the cubic of its ends") {
  const problem p =
      parse_problem(plate_text + "settlement = [ { node = 4, w = -0.1, wy = 0.2, wx = 0.3 } ]\n", "p.toml");
  const calculix_mesh m = calculix_mesh_of(p, 1, 0);
  int middle = -1;
  for (std::size_t i = 6; i < m.nodes.size(); ++i)
    if (m.nodes[i].x == 0.0 && m.nodes[i].y == 0.5) middle = static_cast<int>(i);
  REQUIRE(middle > 0);
  CHECK(m.settled.at({middle, 3}) == Approx(-0.1 / 2 - 0.2 / 8));
  CHECK(m.settled.at({middle, 4}) == Approx(1.5 * -0.1 - 0.2 / 4));
  CHECK(m.settled.at({middle, 5}) == Approx(-0.15));
}

TEST_CASE("a plate's edge along x that is clamped at its nodes is clamped between them") {
  std::string text = plate_text;
  text.replace(text.find("[1, 4]"), 6, "[1, 2, 3]");
  const calculix_mesh m = calculix_mesh_of(parse_problem(text, "pb.toml"), 2, 0);
  int on_edge = 0;
  for (std::size_t i = 0; i < m.nodes.size(); ++i) {
    const bool edge = m.nodes[i].y == 0.0;
    on_edge += edge ? 1 : 0;
    for (const int direction : {3, 4, 5}) CHECK(fixes(m, static_cast<int>(i), direction) == edge);
  }
  CHECK(on_edge == 9);
}

TEST_CASE("a deck's elements, springs and loads name nodes as CalculiX counts them, from 1") {
  std::string text = beam_text;
  text.insert(text.find("[[contact]]"), "[[support]]\nnode = 2\nspring = { w = 7 }\n");
  const calculix_deck deck = deck_of(text, {.refine = 1});
  const auto lines = lines_of(deck.text);
  const auto behind = [&](const std::string& keyword) {
    const auto at = std::find_if(lines.begin(), lines.end(),
                                 [&](const std::string& l) { return l.rfind(keyword, 0) == 0; });
    REQUIRE(at != lines.end());
    return at + 1;
  };
  // Two elements of three nodes each: the problem's nodes 1 to 3, then the middles 4 and 5.
  const auto elements = behind("*ELEMENT,TYPE=B32R");
  CHECK(elements[0] == "1,1,4,2");
  CHECK_THAT(deck.text, Contains("\n2,2,5,3\n"));
  CHECK(deck.nodes == 5);
  // The pair at node 3 and the elastic support at node 2 are springs 3 and 4, to ground nodes 6 and 7.
  CHECK_THAT(deck.text, Contains("\n3,3,6\n") && Contains("\n4,2,7\n"));
  const auto loads = behind("*CLOAD");
  CHECK(loads[0] == fmt::format("2,5,{:.12e}",
                                -4 * deck.force_scale * deck.displacement_scale / deck.displacement_scale));
  CHECK(loads[1] == fmt::format("3,3,{:.12e}", -60 * deck.force_scale));
}

TEST_CASE("an elastic support pulls and pushes, and a pair's spring has no force where it is separated") {
  std::string text = beam_text;
  text.insert(text.find("[[contact]]"), "[[support]]\nnode = 2\nspring = { w = 7 }\n");
  const auto lines = lines_of(deck_of(text).text);
  std::vector<std::vector<std::pair<double, double>>> tables;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].rfind("*SPRING,", 0) != 0) continue;
    auto& table = tables.emplace_back();
    for (std::size_t k = i + 1; k < lines.size() && lines[k][0] != '*'; ++k)
      table.emplace_back(std::stod(lines[k]), std::stod(lines[k].substr(lines[k].find(',') + 1)));
  }
  REQUIRE(tables.size() == 2);
  int both_ways = 0;
  for (const auto& table : tables) {
    const bool pulls = table.back().first > 0.0;
    both_ways += pulls ? 1 : 0;
    REQUIRE(table.size() == (pulls ? 3U : 4U));
    const double face = pulls ? 0.0 : table[2].second;
    // One slope from far away to near the face.
    const double slope = table[0].first / (table[0].second - face);
    CHECK(table[1].first / (table[1].second - face) == Approx(slope).epsilon(1e-9));
    CHECK(std::abs(table[0].second - face) > 2 * std::abs(table[1].second - face));
    if (pulls) CHECK(table[2].first / table[2].second == Approx(slope).epsilon(1e-9));
    if (!pulls) CHECK((table[2].first == 0.0 && table[3].first == 0.0));
  }
  CHECK(both_ways == 1);
}
