#include "contct/structure/load.hpp"

#include "catch.hpp"

using namespace contct::app;

TEST_CASE("between two loads lies their proportional mixture, with equal places merged") {
  const load before{{{2, 0, -10.0}}, {{{-4.0}, {}}}};
  const load after{{{2, 0, -60.0}, {1, 1, 5.0}}, {{{-8.0, 2.0}, {}}, {{1.0}, {0}}}};
  const load at = mix(before, after, 0.1);
  REQUIRE(at.points.size() == 2);
  CHECK(at.points[0].node == 1);
  CHECK(at.points[0].value == Approx(0.5));
  CHECK(at.points[1].value == Approx(-15.0));
  REQUIRE(at.distributed.size() == 2);
  CHECK(at.distributed[0].elements.empty());
  CHECK(at.distributed[0].polynomial[0] == Approx(-4.4));
  CHECK(at.distributed[0].polynomial[1] == Approx(0.2));
  CHECK(at.distributed[1].polynomial[0] == Approx(0.1));
}

TEST_CASE("at the end of a step the load is the step's own, to the bit") {
  const load after{{{0, 0, 0.1}}, {}};
  CHECK(mix({{{0, 0, 0.7}}, {}}, after, 1.0).points[0].value == 0.1);
}

TEST_CASE("point loads at one dof add up") {
  std::vector<double> f(4, 1.0);
  add_point_loads({{{1, 0, 2.0}, {1, 0, 3.0}, {0, 1, -1.0}}, {}}, 2, f);
  CHECK(f == std::vector<double>{1, 0, 6, 1});
}

TEST_CASE("a polynomial is evaluated from its constant on") {
  CHECK(polynomial_at(std::vector<double>{1, -2, 3}, 2.0) == 9.0);
  CHECK(polynomial_at(std::vector<double>{5}, 7.0) == 5.0);
}

TEST_CASE("a distributed load without elements acts on all, another on those it names") {
  const load l{{}, {{{1.0}, {}}, {{2.0, 3.0}, {2, 0}}}};
  std::vector<int> elements;
  std::vector<double> constants;
  for_each_loaded_element(l, 3, [&](int e, const std::vector<double>& polynomial) {
    elements.push_back(e);
    constants.push_back(polynomial[0]);
  });
  CHECK(elements == std::vector<int>{0, 1, 2, 2, 0});
  CHECK(constants == std::vector<double>{1, 1, 1, 2, 2});
}

TEST_CASE("each point of a line stands for half of the intervals beside it") {
  CHECK(tributary_lengths(std::vector<double>{0, 2, 3}) == std::vector<double>{1, 1.5, 0.5});
}
