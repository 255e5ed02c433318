// Tests loads along a path: the load at a share of a step, its resultant, and its description.
#include "contct/session/load_path.hpp"

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"

using namespace contct;

TEST_CASE("the load at an event is described with the keys of the problem file") {
  const problem p = parse_problem(good_problem, "pb.toml");
  CHECK(load_path(p).words_at(1, 0.25, 24) == "w -15 at node 3");
  const problem uniform =
      parse_problem(with("point = [ { node = 3, w = -60.0 } ]", "uniform = -8"), "pb.toml");
  CHECK(load_path(uniform).words_at(1, 0.5, 24) == "uniform -4");
  const problem mixed = parse_problem(with("point = [", "uniform = -8\npoint = ["), "pb.toml");
  // Numbers have six digits. If the text is too long, the place is omitted first, then digits, then the kind.
  CHECK(load_path(p).words_at(1, 1.0 / 3, 24) == "w -20 at node 3");
  CHECK(load_path(p).words_at(1, 0.123456, 20) == "w -7.40736 at node 3");
  CHECK(load_path(p).words_at(1, 0.123456, 19) == "w -7.40736");
  CHECK(load_path(p).words_at(1, 0.123456, 9) == "w -7.41");
  CHECK(load_path(p).words_at(1, 0.000123456, 12) == "w -0.00741");
  CHECK(load_path(mixed).words_at(1, 0.123456, 8) == "-9.38266");
  CHECK(load_path(p).words_at(1, 0.123456, 3).empty());
  CHECK(load_path(mixed).words_at(1, 1.0, 24) == "force -76");
  // From -60 to 10 the load is 0 at a share of 6/7, where its computed sum is only rounding.
  problem passes = p;
  passes.steps.push_back(p.steps[0]);
  passes.steps[1].points[0].value = 10.0;
  CHECK(load_path(passes).words_at(2, 6.0 / 7, 24) == "w 0 at node 3");
  CHECK(load_path(passes).resultant_at(2, 6.0 / 7).force == 0.0);
  CHECK(load_path(passes).words_at(2, 6.0 / 7 + 1e-12, 24) != "w 0 at node 3");
}

TEST_CASE("the description of a load that is not at a node has the coordinates of the load") {
  const auto words = [](load_kind what, double from, double to, model m = beam{{0, 4}, {1.0}}) {
    problem p;
    p.geometry = std::move(m);
    p.steps.resize(1);
    p.steps[0].placed = {{what, from, to, {-5}, {0.25, 0.75}}};
    return load_path(p).words_at(1, 0.5, 60);
  };
  CHECK(words(load_kind::force, 1, 2.5) == "uniform -2.5 from 1 to 2.5");
  CHECK(words(load_kind::curvature, 0, 3) == "curvature -2.5 from 0 to 3");
  CHECK(words(load_kind::point, 3.3, 3.3) == "w -2.5 at x = 3.3");
  CHECK(words(load_kind::moment, 3.3, 3.3) == "theta -2.5 at x = 3.3");
  CHECK(words(load_kind::force, 0.5, 1, plate{{0, 1}, {0, 1}, 1.0, 0.3}) ==
        "uniform -2.5 from (0.5, 0.25) to (1, 0.75)");
}

TEST_CASE("a load of several parts without a force is described by the largest of its first kind") {
  const std::string beam = with("point = [ { node = 3, w = -60.0 } ]", "");
  std::string many = "curvature = [ ";
  for (int i = 0; i < 40; ++i) many += "{ value = 1e-5, from = 0.0, to = 0.5 }, ";
  const std::pair<std::string, std::string> loads[] = {
      {"curvature = [ { value = 1.5e-5 }, { value = -2.5e-5, from = 0, to = 1 } ]", "curvature -2.5e-05"},
      {"curvature = [ { value = 1.5e-5, from = 0, to = 1 } ]\nsettlement = [ { node = 1, w = -1 } ]",
       "curvature 1.5e-05 from 0 to 1"},
      {"point = [ { node = 2, theta = 1 }, { node = 3, theta = -2 } ]", "theta -2"},
      {"point = [ { x = 0.5, theta = 1 }, { node = 3, theta = 1 } ]", "theta 1"},
      {"settlement = [ { node = 1, w = -1 }, { node = 1, theta = 3 } ]", "settle theta 3"},
      {"settlement = [ { node = 1, w = -1 } ]\nmove = [ { node = 3, w = -3 } ]", "settle w -1 at node 1"},
      {"point = [ { node = 2, w = 1 }, { node = 3, w = -1 } ]", "force 0"},
      {"uniform = [ { polynomial = [1, 2] } ]", "force 6"},
      {"uniform = [ { polynomial = [1, 2], from = 0, to = 1 } ]", "force 2"},
      {many + "]", "curvature 1e-05"}};
  for (const auto& [text, words] : loads) {
    const problem p = parse_problem(beam + text + "\n", "pb.toml");
    CAPTURE(text);
    CHECK(load_path(p).words_at(1, 1.0, 60) == words);
  }
}

TEST_CASE("the load on a plate is described as a force, or as wx or wy at a node") {
  const problem p = parse_problem(good_plate, "pb.toml");
  CHECK(load_path(p).words_at(1, 1.0, 24) == "force -3");
  const std::string mistake = "uniform = [ { value = -1.0 }, { value = -2.0, elements = \"2..2\" } ]\n";
  const problem slope = parse_problem(
      plate_with(mistake + "point = [ { node = 3, w = -1.0, wx = 0.25 }, { node = 6, wy = -0.5 } ]",
                 "point = [ { node = 6, wy = -0.5 } ]"),
      "pb.toml");
  CHECK(load_path(slope).words_at(1, 0.5, 24) == "wy -0.25 at node 6");
}

TEST_CASE(
    "within a step, the load changes linearly from the load of the previous step, and from 0 in the first "
    "step") {
  const problem p =
      parse_problem(std::string(good_problem) + "[[step]]\npoint = [ { node = 3, w = 20.0 } ]\n", "pb.toml");
  const load_path loads(p);
  CHECK(loads.at(0, 1.0).points.empty());
  CHECK(loads.at(1, 0.5).points[0].value == -30.0);
  CHECK(loads.at(2, 0.25).points[0].value == -40.0);
  CHECK(loads.resultant_at(2, 0.25).force == -40.0);
  CHECK(loads.resultant_at(2, 0.25).moments == std::vector<double>{-80.0});
  CHECK_FALSE(loads.has_many_parts(2));
  problem far = p;  // after a large moment about x = 0, a small one keeps its digits
  std::get<beam>(far.geometry.kind).x = {1e9, 1e9 + 1, 1e9 + 2};
  far.steps[1].points = {{1, 0, -2.7}, {2, 0, 2.7}};
  CHECK(load_path(far).resultant_at(2, 1.0).moments == std::vector<double>{2.7});
}

TEST_CASE("a list of loaded elements is written as a range if their numbers are consecutive") {
  CHECK(is_run({4}));
  CHECK(is_run({4, 5, 6}));
  CHECK_FALSE(is_run({4, 6}));
  CHECK_FALSE(is_run({6, 5, 4}));
}
