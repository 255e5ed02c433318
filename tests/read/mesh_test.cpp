// Tests which node a coordinate names, and the meshes that element_size makes.
#include <algorithm>

#include "catch.hpp"
#include "contct/read/node_reader.hpp"
#include "contct/read/problem_file.hpp"
#include "read/refusals.hpp"

using namespace contct;

namespace {

problem of(const std::string& text) {
  return parse_problem(text + "[[step]]\nuniform = -1\n", "pb.toml");
}

/// Returns the nodes of a beam given by these lines.
std::vector<double> nodes_of(const std::string& beam_lines, const std::string& rest = "") {
  return std::get<beam>(of("[beam]\n" + beam_lines + "\n" + rest).geometry.kind).x;
}

double longest(const std::vector<double>& x) {
  double most = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) most = std::max(most, x[i] - x[i - 1]);
  return most;
}

}  // namespace

TEST_CASE(
    "a coordinate is a node's if both decimals are equal, or if the exact place of a node of equal elements "
    "rounds to it") {
  constexpr const char* far = "x = [0, 1e-9, 1e6]";
  constexpr const char* thirds = "length = 3.5\nelements = 3";               // node 2 is at 7/6
  constexpr const char* near = "length = 3.9000000000000004\nelements = 3";  // node 2 is 1.3e-16 beyond 1.3
  struct {
    const char *beam = nullptr, *x = nullptr;
    int node = -1;  // from 0; -1: none
    bool has_warning = false;
  } const rows[] = {
      {far, "1.0e-9", 1},
      {far, "1.5e-9", -1},
      {far, "999999.9999999999", -1},
      {thirds, "1.16666666666667", 1, true},
      {thirds, "1.1666666667", -1},
      {thirds, "1.16666666666666666667", 1, true},
      {thirds, "3.4999999999999996", -1},
      {near, "1.3", -1},
      {near, "1.3000000000000001", 1, true},
      {"length = 0.7\nelements = 7", "0.3", 3},
      {"length = 0.7\nelements = 7", "0.30000000000000004", -1},
      {"length = 28\nelements = 3", "9.333333333333334", 1, true},  // the double nearest to 28 / 3
      {"length = 246913578024.5\nelements = 2", "123456789012", 1, true},
  };
  for (const auto& [lines, x, node, has_warning] : rows) {
    INFO(lines << ": " << x);
    const problem p =
        parse_problem("[beam]\n" + std::string(lines) +
                          "\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n[[step]]\npoint = [ { x = " + x +
                          ", w = 1 } ]\ncurvature = [ { value = 1, to = " + x + " } ]\n",
                      "pb.toml");
    const load& l = p.steps.at(0);
    REQUIRE(l.points.size() + l.placed.size() == 2);
    CHECK((l.points.empty() ? -1 : l.points[0].node) == node);
    const beam& b = std::get<beam>(p.geometry.kind);
    const line<rational> points(b.x, b.runs);
    const rational to = points.place(l.placed.back().to);
    CHECK(to == (node < 0 ? decimal_of(std::stod(x)) : points.at(node)));
    CHECK(std::ranges::count_if(p.warnings, [](const std::string& w) {
            return w.find("; taken as node 2, at ") != std::string::npos;
          }) == (has_warning ? 2 : 0));
  }
}

TEST_CASE(
    "a grid line of equal elements is named by 12 digits of its exact place, and a warning names the line") {
  const problem p = parse_problem(
      "[plate]\nsize = [3.5, 7]\nelements = [3, 3]\nD = 1\nnu = 0\n[[support]]\nat = [1.16666666666667, "
      "2.33333333333]\nfix = \"w\"\n"
      "[[step]]\nuniform = [ { value = 1, from = [0, 2.33333333333], to = [1.1666666666, 7] } ]\n",
      "pb.toml");
  CHECK(p.supports.at(0).node == 5);
  CHECK(p.steps.at(0).placed.at(0).across[0].point == 1);
  CHECK(p.steps[0].placed[0].to == 1.1666666666);
  REQUIRE(p.warnings.size() == 3);
  CHECK(p.warnings[1] ==
        "pb.toml:7:25: support[1].at[2]: found 2.33333333333; taken as grid line along y 2, at 7/3");
}

TEST_CASE("a beam is divided into the fewest equal elements that are not longer than element_size") {
  const std::vector<double> x = nodes_of("length = 10\nelement_size = 0.25\nEI = 1");
  REQUIRE(x.size() == 41);
  for (int i = 0; i <= 40; ++i) CHECK(x[i] == 0.25 * i);
  CHECK(nodes_of("length = 0.9\nelement_size = 0.3\nEI = 1") == std::vector<double>{0, 0.3, 0.6, 0.9});
  CHECK(nodes_of("length = 0.7\nelement_size = 0.1\nEI = 1") ==
        std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7});
  CHECK(nodes_of("length = 1\nelement_size = 0.3\nEI = 1") == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  CHECK(nodes_of("length = 1\nelement_size = 5\nEI = 1") == std::vector<double>{0, 1});
}

TEST_CASE("with element_size, a node is made at every x in any table of the problem file") {
  const std::vector<double> x = nodes_of(
      "length = 10.0\nelement_size = 2.5\nEI = [ { to = 4.1, value = 1 }, { to = 10, value = 2 } ]",
      "[[support]]\nx = [0, 0.3]\nfix = \"w\"\n[[contact]]\nx = [7.77, 0.3]\nsurface = \"below\"\nface = "
      "-1\nstiffness = 1\n[[bed]]\nmodulus = 1e-3\nface = 0\nx = 5.5\n"
      "[[step]]\npoint = [ { x = 6.1, w = 1 } ]\nsettlement = [ { x = 0.3, w = -1 } ]\n"
      "[[step]]\npoint = [ { x = [9.9, 9.5], w = 1 } ]\n");
  for (const double named : {0.0, 0.3, 4.1, 5.5, 6.1, 7.77, 9.5, 9.9, 10.0}) {
    INFO(named);
    CHECK(std::ranges::count(x, named) == 1);
  }
  CHECK(longest(x) <= 2.5);
  CHECK(x.size() == 10);  // the named nodes, and one between 0.3 and 4.1
}

TEST_CASE("with element_size, nodes listed in x are kept, and the lengths between them are divided") {
  CHECK(nodes_of("x = [-1, 0, 0.5, 3]\nelement_size = 1\nEI = 1", "[[support]]\nx = 2\nfix = \"w\"\n") ==
        std::vector<double>{-1, 0, 0.5, 1.25, 2, 3});
}

TEST_CASE(
    "two spellings of a coordinate, or of one that rounds to another, become one node, and any other two "
    "become two") {
  const auto nodes_with = [](const std::string& first, const std::string& second) {
    return nodes_of("length = 1\nelement_size = 1\nEI = 1", "[[support]]\nx = [" + first +
                                                                ", 1.0]\nfix = \"w\"\n[[support]]\nx = [" +
                                                                second + ", 0]\nfix = \"theta\"\n");
  };
  CHECK(nodes_with("0.3", "0.30") == std::vector<double>{0, 0.3, 1});
  CHECK(nodes_with("0.3", "0.30000000000000004") == std::vector<double>{0, 0.3, 0.30000000000000004, 1});
  CHECK(nodes_with("0.333333333333", "0.33333333333333331") == std::vector<double>{0, 1.0 / 3, 1});
  CHECK(nodes_with("0.33333333333", "0.33333333333333331") ==
        std::vector<double>{0, 0.33333333333, 1.0 / 3, 1});
}

TEST_CASE("with element_size, a node number in the file is a number in the finished mesh") {
  const problem p =
      of("[beam]\nlength = 1\nelement_size = 0.5\nEI = 1\n[[support]]\nx = 0.7\nfix = \"w\"\n"
         "[[support]]\nnode = 3\nspring = { w = 1 }\n");
  CHECK(std::get<beam>(p.geometry.kind).x == std::vector<double>{0, 0.35, 0.7, 1});
  CHECK(p.supports[0].node == p.supports[1].node);
}

TEST_CASE("with element_size, 2,000,000 elements are accepted, but not one more") {
  const auto sized = [](const std::string& size) {
    return verdict([&] { (void)nodes_of("length = 2000000\nelement_size = " + size + "\nEI = 1"); });
  };
  CHECK(sized("1") == "accepted");
  CHECK_THAT(sized("0.9999999"), Catch::Matchers::Contains("which makes 2000001 elements"));
}
