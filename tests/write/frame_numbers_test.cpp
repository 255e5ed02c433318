// What pictures and tables read off a state.
#include "contct/write/frame_numbers.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/structures.hpp"

using namespace contct::app;

namespace {

placed_nodes at_places(const std::vector<in_space>& at, const std::vector<int>& directions) {
  placed_nodes places;
  for (const in_space& p : at) places.nodes.push_back({std::to_string(places.nodes.size()), p});
  for (const int direction : directions) places.dofs.push_back({0, direction});
  return places;
}

}  // namespace

TEST_CASE("a flat structure that stays flat is looked at straight on, any other from the front and above") {
  const std::vector<in_space> in_xy = {{0, 0, 1}, {1, 0, 1}, {0, 2, 1}};
  const std::vector<in_space> in_xz = {{0, 5, 1}, {1, 5, 0}, {0, 5, 2}};
  const std::vector<in_space> in_yz = {{3, 5, 1}, {3, 4, 0}, {3, 5, 2}};
  const auto view = [](const std::vector<in_space>& at, const std::vector<int>& directions) {
    return std::string(view_at(fitting_view(at_places(at, directions))).name);
  };
  CHECK(view(in_xy, {1, 2, 6}) == "xy");
  CHECK(view(in_xy, {3, 4, 5}) == "oblique");
  CHECK(view(in_xz, {1, 3}) == "xz");
  CHECK(view(in_yz, {2, 3, 4}) == "yz");
  CHECK(view({{0, 0, 0}, {1, 1, 1}}, {1}) == "oblique");
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {3}) == "xz");  // a beam along x
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {2}) == "xy");
  for (int i = 0; i < views; ++i) {
    const structure_view& v = view_at(i);
    INFO(v.name);
    CHECK(length_of(v.right) == Approx(1).epsilon(1e-3));
    CHECK(length_of(v.up) == Approx(1).epsilon(1e-3));
    CHECK(std::abs(v.x_of(v.up)) < 1e-3);
  }
}

TEST_CASE("what deflects is what is known to be a length: a matrix's pairs, and what is along an axis") {
  const problem placed = parse_problem(portal_frame(), "p.toml");
  const std::vector<int> dofs = deflecting_nodes(placed);
  CHECK(dofs.size() == 22);
  CHECK(std::none_of(dofs.begin(), dofs.end(), [](int dof) { return dof % 3 == 2; }));
  problem bare = parse_problem(frame_without_coordinates(), "p.toml");
  CHECK(deflecting_nodes(bare) == std::vector<int>{16, 21});
  bare.pairs.clear();
  CHECK(deflecting_nodes(bare).size() == 33);
}

TEST_CASE("a pair is read at its deflection: gap or force, never both") {
  const problem p = parse_problem(good_problem, "pb.toml");  // face -0.004, stiffness 5e4
  const pair_reading open = reading_of(p.pairs[0], -0.001, false);
  CHECK(open.gap == Approx(0.003));
  CHECK(open.force == 0.0);
  CHECK(open.look == pair_look::open);
  const pair_reading closed = reading_of(p.pairs[0], -0.005, true);
  CHECK(closed.gap == 0.0);
  CHECK(closed.force == Approx(50.0));
  CHECK(closed.look == pair_look::closed);
  CHECK(reading_of(p.pairs[0], -0.004, false).look == pair_look::at_face);
}

TEST_CASE("the largest value is so by magnitude, and the first of equals") {
  extreme most;
  most.take(3, -2.0);
  most.take(4, 1.0);
  most.take(5, 2.0);
  CHECK(most.at == 3);
  CHECK(most.value == -2.0);
}

TEST_CASE("a plate's nodes go along x first, and w is the first of a node's dofs") {
  const problem p = parse_problem(good_plate, "pb.toml");
  CHECK(place_of_node(p.geometry, 4).x == 0.5);
  CHECK(place_of_node(p.geometry, 4).y == 1.0);
  CHECK(place_name(p.geometry, 4) == "5");
  std::vector<double> u(18);
  u[12] = 7.0;
  CHECK(deflection_of(p, u, 4) == 7.0);
}
