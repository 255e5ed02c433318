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
    "a coordinate refers to the node with the same decimal, although the doubles of the mesh are rounded") {
  for (const auto& [length, elements] : {std::pair(1.0, 10), {0.7, 7}, {1.1, 11}, {2.3, 23}, {12.3, 123}}) {
    std::vector<double> x;
    for (int i = 0; i <= elements; ++i) x.push_back(length * i / elements);
    for (int i = 0; i <= elements; ++i) {
      const double written = std::stod(std::to_string(i / 10) + "." + std::to_string(i % 10));
      CHECK(find_coordinate(x, written) == i);
    }
    CHECK_FALSE(find_coordinate(x, 0.3 + 1e-14 * length));
    CHECK_FALSE(find_coordinate(x, -0.1));
    CHECK_FALSE(find_coordinate(x, length + 0.1));
  }
  CHECK(0.7 * 3 / 7 != 0.3);
  CHECK(find_coordinate(std::vector<double>{0.0, 0.1 + 0.2, 1.0}, 0.3) == 1);
  // The tolerance is relative to the end with the larger magnitude.
  CHECK(find_coordinate(std::vector<double>{-1000.3, 0.0, 5.0}, 1e-14) == 1);
}

TEST_CASE("if several nodes are within rounding of a coordinate, the coordinate refers to the nearest one") {
  const std::vector<double> x = {0.0, 1.0 - 2e-16, 1.0, 1.0 + 4e-16};
  for (int i = 0; i < 4; ++i) CHECK(find_coordinate(x, x[i]) == i);
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

TEST_CASE("a coordinate that occurs in two spellings, or twice up to rounding, becomes one node") {
  CHECK(nodes_of("length = 1\nelement_size = 1\nEI = 1",
                 "[[support]]\nx = [0.3, 1.0]\nfix = \"w\"\n[[support]]\nx = [0.30000000000000004, 0]\nfix = "
                 "\"theta\"\n") == std::vector<double>{0, 0.3, 1});
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
