// What pictures and tables read off a path.
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
    return std::string(all_views[fitting_view(at_places(at, directions))].name);
  };
  CHECK(view(in_xy, {1, 2, 6}) == "xy");
  CHECK(view(in_xy, {3, 4, 5}) == "oblique");
  CHECK(view(in_xz, {1, 3}) == "xz");
  CHECK(view(in_yz, {2, 3, 4}) == "yz");
  CHECK(view({{0, 0, 0}, {1, 1, 1}}, {1}) == "oblique");
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {3}) == "xz");  // a beam along x
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {2}) == "xy");
  for (const structure_view& v : all_views) {
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

TEST_CASE("an event's load is told in the words of the problem file") {
  const problem p = parse_problem(good_problem, "pb.toml");
  CHECK(load_path(p).words_at(1, 0.25, 24) == "w -15 at node 3");
  const problem uniform =
      parse_problem(with("point = [ { node = 3, w = -60.0 } ]", "uniform = -8"), "pb.toml");
  CHECK(load_path(uniform).words_at(1, 0.5, 24) == "uniform -4");
  const problem mixed = parse_problem(with("point = [", "uniform = -8\npoint = ["), "pb.toml");
  // Digits go before anything is cut.
  CHECK(load_path(p).words_at(1, 1.0 / 3, 24) == "w -20 at node 3");
  CHECK(load_path(p).words_at(1, 0.123456, 17) == "w -7.41 at node 3");
  CHECK(load_path(p).words_at(1, 0.123456, 8) == "-7.41");
  CHECK(load_path(p).words_at(1, 0.123456, 3).empty());
  CHECK(load_path(mixed).words_at(1, 1.0, 24) == "force -76");
}

TEST_CASE("a plate's loads are told in its own words") {
  const problem p = parse_problem(good_plate, "pb.toml");
  CHECK(load_path(p).words_at(1, 1.0, 24) == "force -3");
  const std::string mistake = "uniform = [ { value = -1.0 }, { value = -2.0, elements = \"2..2\" } ]\n";
  const problem slope = parse_problem(
      plate_with(mistake + "point = [ { node = 3, w = -1.0, wx = 0.25 }, { node = 6, wy = -0.5 } ]",
                 "point = [ { node = 6, wy = -0.5 } ]"),
      "pb.toml");
  CHECK(load_path(slope).words_at(1, 0.5, 24) == "wy -0.25 at node 6");
}

TEST_CASE("between steps the load goes straight from one total to the next, from nothing at first") {
  const problem p =
      parse_problem(std::string(good_problem) + "[[step]]\npoint = [ { node = 3, w = 20.0 } ]\n", "pb.toml");
  const load_path loads(p);
  CHECK(loads.at(0, 1.0).points.empty());
  CHECK(loads.at(1, 0.5).points[0].value == -30.0);
  CHECK(loads.at(2, 0.25).points[0].value == -40.0);
  CHECK(loads.resultant_at(2, 0.25).force == -40.0);
  CHECK(loads.resultant_at(2, 0.25).moments == std::vector<double>{-80.0});
  CHECK_FALSE(loads.has_many_parts(2));
}

TEST_CASE("elements are a run when they follow one another upwards") {
  CHECK(is_run({4}));
  CHECK(is_run({4, 5, 6}));
  CHECK_FALSE(is_run({4, 6}));
  CHECK_FALSE(is_run({6, 5, 4}));
}
