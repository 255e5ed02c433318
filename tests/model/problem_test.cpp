// Tests functions that beams, plates and matrices have in common.
#include "contct/model/problem.hpp"

#include <string>

#include "catch.hpp"

using namespace contct;

namespace {

const beam two_spans{{0.0, 1.0, 3.0}, {2.0, 2.0}};
const plate small{{1.0, 2.0, 4.0}, {0.0, 1.0}, 1.0, 0.3};

std::vector<std::string> names_of(const model& m) {
  const auto names = dof_names(m);
  return {names.begin(), names.end()};
}

}  // namespace

TEST_CASE(
    "a beam and a plate have counts of nodes, elements and dofs, names of dofs, and tributary shares of "
    "nodes") {
  const model b{two_spans};
  CHECK(nodes(b) == 3);
  CHECK(elements(b) == 2);
  CHECK(dofs_per_node(b) == 2);
  CHECK(dofs(b) == 6);
  CHECK(names_of(b) == std::vector<std::string>{"w", "theta"});
  CHECK(tributary_shares(b) == std::vector<double>{0.5, 1.5, 1.0});
  const model p{small};
  CHECK(nodes(p) == 6);
  CHECK(elements(p) == 2);
  CHECK(dofs_per_node(p) == 3);
  CHECK(dofs(p) == 18);
  CHECK(names_of(p) == std::vector<std::string>{"w", "wx", "wy"});
  CHECK(tributary_shares(p) == std::vector<double>{0.25, 0.75, 0.5, 0.25, 0.75, 0.5});
}

TEST_CASE("the resultant of a load has a force, and one moment on a beam or two moments on a plate") {
  const resultant b = resultant_of(model{two_spans}, {{{1, 0, -4.0}, {2, 1, 0.5}}, {{{-2.0}, {1}}}});
  CHECK(b.force == Approx(-8.0));
  REQUIRE(b.moments.size() == 1);
  CHECK(b.moments[0] == Approx(-4.0 * 1 - 4.0 * 2 + 0.5));
  // Element 2 covers x from 2 to 4 and y from 0 to 1; node 4 is at (1, 1).
  const resultant p =
      resultant_of(model{small}, {{{3, 0, -4.0}, {0, 1, 0.5}, {0, 2, 0.25}}, {{{-1.0}, {1}}}});
  CHECK(p.force == Approx(-6.0));
  REQUIRE(p.moments.size() == 2);
  CHECK(p.moments[0] == Approx(-4.0 * 1 - 2.0 * 3 + 0.5));
  CHECK(p.moments[1] == Approx(-4.0 * 1 - 2.0 * 0.5 + 0.25));
}

TEST_CASE("the resultant of a load is exact, although powers of x or loads cancel") {
  const load far{{}, {{{1e18, -6e15, 1.5e13, -2e10, 1.5e7, -6000, 1}, {}}}};  // (x - 1000)^6
  const resultant r = resultant_of(model{beam{{1000, 1001, 1002}, {1, 1}}}, far);
  CHECK(r.force == 128.0 / 7);
  CHECK(r.moments[0] == 128.0 * 1000 / 7 + 32);
  const load cancels{{{0, 0, 0.1}, {1, 0, 0.2}, {2, 0, -0.3}}, {}};
  CHECK(resultant_of(model{two_spans}, cancels).force == 0.0);
  CHECK(resultant_of(model{small}, cancels).force == 0.0);
  assembled matrix;
  matrix.stiffness.order = 3;
  CHECK(resultant_of(model{matrix}, cancels).force == 0.0);
}

TEST_CASE("point loads at one dof add up") {
  std::vector<double> f(6, 1.0);
  add_consistent_loads(two_spans, {{{1, 0, 2.0}, {1, 0, 3.0}, {0, 1, -1.0}}, {}}, f);
  CHECK(f == std::vector<double>{1, 0, 6, 1, 1, 1});
}

TEST_CASE("if a fixed dof has a spring and settles, its reaction also balances the force of the spring") {
  const std::vector<support> supports = {{1, 0, true}, {1, 0, false, 4.0}, {1, 0, true}};
  const load l{{{1, 0, -3.0}}, {}, {{1, 0, 0.5}}};
  const std::vector<double> all_up = {0.5, 0, 0.5, 0, 0.5, 0};  // no element is bent
  const std::vector<double> r = reactions(two_spans, l, supports, all_up);
  // The reactions balance the load: 5 - 2 = 3. The third support, which fixes the same dof again, gets 0.
  CHECK(r == std::vector<double>{5.0, -2.0, 0.0});
}
