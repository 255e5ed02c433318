#include "contct/structure/load.hpp"

#include "catch.hpp"

using namespace contct;

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
