#include "contct/structure/rigid_modes.hpp"

#include "catch.hpp"

using namespace contct::app;

TEST_CASE("two deflections at different places hold a beam, twice at one place does not") {
  rigid_rank same;
  same.hold({1, 0.5, 0});
  same.hold({1, 0.5, 0});
  CHECK(same.rank() == 1);
  same.hold({1, 0.5000001, 0});
  CHECK(same.rank() == 2);
}

TEST_CASE("rotations alone leave a beam free to rise") {
  rigid_rank r;
  r.hold({0, 1, 0});
  r.hold({0, 1, 0});
  CHECK(r.rank() == 1);
  r.hold({1, 0.9, 0});
  CHECK(r.rank() == 2);
}

TEST_CASE("three points on a line do not hold a plate, a fourth beside it does") {
  rigid_rank r;
  r.hold({1, -0.3, -0.1});
  r.hold({1, 0.1, 0.3});
  r.hold({1, 0.5, 0.7});
  CHECK(r.rank() == 2);
  r.hold({1, 0.5, 0.6999});
  CHECK(r.rank() == 3);
  r.hold({1, 1, 1});
  CHECK(r.rank() == 3);
}

TEST_CASE("only a row's direction counts: lengths of 1e-200 or 1e200 make no difference") {
  for (const double size : {1e-200, 1.0, 1e200}) {
    rigid_rank r;
    r.hold({0, size, 0});
    r.hold({0, 2 * size, 0});
    CHECK(r.rank() == 1);
    r.hold({1, 1, 0});
    CHECK(r.rank() == 2);
    r.hold({0, 0, size});
    CHECK(r.rank() == 3);
  }
  rigid_rank none;
  none.hold({0, 0, 0});
  CHECK(none.rank() == 0);
}
