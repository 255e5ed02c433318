// Tests exact solutions that are computed digit by digit modulo a prime.
#include "contct/exact/lifted_solver.hpp"

#include <numeric>

#include "catch.hpp"
#include "contct/number/random.hpp"

using namespace contct;

namespace {

std::vector<int> in_order(std::size_t n) {
  std::vector<int> places(n);
  std::iota(places.begin(), places.end(), 0);
  return places;
}

/// (K + springs) x.
rational_vector product(const contct::rational_rows& k, const std::vector<added_spring>& springs,
                        const rational_vector& x) {
  rational_vector y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const auto& [j, entry] : k[i]) y[i] += entry * x[static_cast<std::size_t>(j)];
  for (const added_spring& s : springs)
    y[static_cast<std::size_t>(s.dof)] += s.stiffness * x[static_cast<std::size_t>(s.dof)];
  return y;
}

/// Returns a free chain of springs with stiffnesses 1/3 + i.
contct::rational_rows chain(std::size_t n) {
  contct::rational_rows k(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const rational stiffness = rational(1, 3) + static_cast<int>(i);
    const auto a = static_cast<int>(i);
    k[i][a] += stiffness;
    k[i + 1][a + 1] += stiffness;
    k[i][a + 1] -= stiffness;
    k[i + 1][a] -= stiffness;
  }
  return k;
}

}  // namespace

TEST_CASE("the exact solver solves a chain of springs for any numbering of the points") {
  const contct::rational_rows k = chain(7);
  const std::vector<char> fixed(7, 0);
  const std::vector<added_spring> springs = {{0, rational(1, 7)}, {4, rational(22, 7)}};
  rational_vector b(7);
  b[2] = rational(5, 11);
  b[6] = -3;
  for (const std::vector<int>& places : {in_order(7), std::vector<int>{6, 5, 4, 3, 2, 1, 0}}) {
    lifted_solver solver(k, fixed, places);
    solver.factor(springs);
    CHECK(solver.free_motions().empty());
    CHECK(product(k, springs, solver.solve(b)) == b);
  }
}

TEST_CASE("the exact solver gives fixed dofs no displacement") {
  const contct::rational_rows k = chain(3);
  const std::vector<char> fixed = {1, 0, 0};
  const std::vector<int> places = in_order(3);
  lifted_solver solver(k, fixed, places);
  solver.factor({});
  CHECK(solver.solve({0, 0, 1}) == rational_vector{0, 3, rational(3) + rational(3, 4)});
}

TEST_CASE(
    "the exact solver finds the rigid-body motion of a free chain, and solves for a load in equilibrium") {
  const contct::rational_rows k = chain(5);
  const std::vector<char> fixed(5, 0);
  const std::vector<int> places = in_order(5);
  lifted_solver solver(k, fixed, places);
  solver.factor({});
  REQUIRE(solver.free_motions().size() == 1);
  CHECK(solver.free_motions()[0] == rational_vector{1, 1, 1, 1, 1});
  const rational_vector b = {1, 0, rational(-1, 2), 0, rational(-1, 2)};
  CHECK(product(k, {}, solver.solve(b)) == b);
}

TEST_CASE("the exact solver takes another prime if a stiffness is 0 modulo the first prime") {
  contct::rational_rows k(2);
  k[0] = {{0, rational(integer((std::uint64_t{1} << 61U) - 1))}};
  k[1] = {{1, rational(2)}};
  const std::vector<char> fixed(2, 0);
  const std::vector<int> places = in_order(2);
  lifted_solver solver(k, fixed, places);
  solver.factor({});
  CHECK(solver.free_motions().empty());
  CHECK(solver.solve({1, 1}) ==
        rational_vector{rational(integer(1), integer("2305843009213693951")), rational(1, 2)});
}

TEST_CASE("the exact solver refuses an indefinite matrix with zeros on the diagonal") {
  contct::rational_rows k(2);
  k[0] = {{0, rational(0)}, {1, rational(1)}};
  k[1] = {{0, rational(1)}, {1, rational(0)}};
  const std::vector<char> fixed(2, 0);
  const std::vector<int> places = in_order(2);
  lifted_solver solver(k, fixed, places);
  CHECK_THROWS_WITH(solver.factor({}), Catch::Matchers::Contains("indefinite"));
}

TEST_CASE("the exact solver refuses to compute with more bits than allowed, and reports the limit") {
  contct::rational_rows k = chain(30);
  for (std::size_t i = 0; i < k.size(); ++i)
    k[i][static_cast<int>(i)] += rational(1, 1000003 + 2 * static_cast<int>(i));
  const std::vector<char> fixed(30, 0);
  const std::vector<int> places = in_order(30);
  rational_vector b(30);
  b[0] = 1;
  lifted_solver solver(k, fixed, places);
  solver.factor({});
  CHECK(length_in_bits(solver.solve(b)[29]) > 600);
  lifted_solver limited(k, fixed, places, 500);
  limited.factor({});
  CHECK_THROWS_WITH(limited.solve(b), Catch::Matchers::Contains("more than 500 bits"));
}
