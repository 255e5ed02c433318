// Tests exact solutions that are computed digit by digit modulo a prime, and whether a matrix is
// semidefinite.
#include "contct/exact/lifted_solver.hpp"

#include <numeric>

#include "catch.hpp"
#include "contct/number/random.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

/// A solver of (K + springs) u = b, with the points in order unless `places` is given.
struct solved {
  explicit solved(rational_rows rows, std::vector<added_spring> added = {}, std::vector<char> held = {},
                  std::vector<int> in_places = {}, std::size_t most = lifted_solver::most_bits)
      : k(std::move(rows)), springs(std::move(added)), fixed(std::move(held)), places(std::move(in_places)) {
    fixed.resize(k.size());
    if (places.empty()) {
      places.resize(k.size());
      std::iota(places.begin(), places.end(), 0);
    }
    solver.emplace(k, fixed, places, most);
    solver->factor(springs);
  }
  /// (K + springs) x.
  [[nodiscard]] rational_vector times(const rational_vector& x) const {
    rational_vector y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      for (const auto& [j, entry] : k[i]) y[i] += entry * x[static_cast<std::size_t>(j)];
    for (const added_spring& s : springs) y[s.dof] += s.stiffness * x[s.dof];
    return y;
  }

  rational_rows k;
  std::vector<added_spring> springs;
  std::vector<char> fixed;
  std::vector<int> places;
  std::optional<lifted_solver> solver;
};

/// Returns a free chain of springs with stiffnesses 1/3 + i.
rational_rows chain(int n) {
  rational_rows k(n);
  for (int i = 0; i + 1 < n; ++i)
    for (const int a : {i, i + 1})
      for (const int b : {i, i + 1}) k[a][b] += (a == b ? 1 : -1) * (rational(1, 3) + i);
  return k;
}

using entries = std::vector<matrix_entry>;

struct decided {
  exact_problem exactly;
  definiteness what;

  /// Returns true if negative work is reported and an independent sum confirms this work.
  [[nodiscard]] bool shows() const {
    if (!what.shown || what.semidefinite) return false;
    rational sum;
    for (std::size_t i = 0; i < exactly.dofs(); ++i)
      for (const auto& [j, k] : exactly.stiffness[i])
        sum += what.shown->motion[i] * k * what.shown->motion[j];
    return sum < 0 && sum == what.shown->work;
  }
};

/// Returns the definiteness of a matrix given by its lower triangle.
decided of(int n, const entries& lower, int fixed = -1) {
  problem p = on_matrix({n, lower, {}}, {}, {});
  if (fixed >= 0) p.supports = {{fixed, 0, true}};
  const exact_problem e = exact_problem_of(p);
  return {e, definiteness_of(p, e)};
}

decided pair_of(double coupling, double last) {
  return of(2, {{0, 0, 1.0}, {1, 0, coupling}, {1, 1, last}});
}

/// Returns a free chain of springs with `more` added to the stiffness of the first node.
entries chain(int n, double more) {
  entries all;
  for (int i = 0; i < n; ++i) {
    all.push_back({i, i, (i == 0 || i + 1 == n ? 1.0 : 2.0) + (i == 0 ? more : 0.0)});
    if (i > 0) all.push_back({i, i - 1, -1.0});
  }
  return all;
}

}  // namespace

TEST_CASE("the exact solver solves a chain of springs in any order, and does not move fixed dofs") {
  const rational_vector b = {0, 0, rational(5, 11), 0, 0, 0, -3};
  for (const std::vector<int>& places : {std::vector<int>(), std::vector<int>{6, 5, 4, 3, 2, 1, 0}}) {
    solved s(chain(7), {{0, rational(1, 7)}, {4, rational(22, 7)}}, {}, places);
    CHECK(s.solver->free_motions().empty());
    CHECK(s.times(s.solver->solve(b)) == b);
  }
  CHECK(solved(chain(3), {}, {1, 0, 0}).solver->solve({0, 0, 1}) ==
        rational_vector{0, 3, rational(3) + rational(3, 4)});
}

TEST_CASE(
    "the exact solver finds the rigid-body motion of a free chain, and solves for a load in equilibrium") {
  solved s(chain(5));
  REQUIRE(s.solver->free_motions().size() == 1);
  CHECK(s.solver->free_motions()[0] == rational_vector{1, 1, 1, 1, 1});
  const rational_vector b = {1, 0, rational(-1, 2), 0, rational(-1, 2)};
  CHECK(s.times(s.solver->solve(b)) == b);
}

TEST_CASE("the exact solver takes another prime if a stiffness is 0 modulo the first prime") {
  solved s({{{0, rational(integer((std::uint64_t{1} << 61U) - 1))}}, {{1, rational(2)}}});
  CHECK(s.solver->free_motions().empty());
  CHECK(s.solver->solve({1, 1}) ==
        rational_vector{rational(integer(1), integer("2305843009213693951")), rational(1, 2)});
}

TEST_CASE("the exact solver refuses an indefinite matrix, and more bits than allowed") {
  CHECK_THROWS_WITH(solved({{{0, rational(0)}, {1, rational(1)}}, {{0, rational(1)}, {1, rational(0)}}}),
                    Contains("indefinite"));
  rational_rows k = chain(30);
  for (int i = 0; i < 30; ++i) k[i][i] += rational(1, 1000003 + 2 * i);
  rational_vector b(30);
  b[0] = 1;
  CHECK(length_in_bits(solved(k).solver->solve(b)[29]) > 600);
  CHECK_THROWS_WITH(solved(k, {}, {}, {}, 500).solver->solve(b), Contains("more than 500 bits"));
}

TEST_CASE(
    "a matrix that is singular in doubles is classified without rounding, as semidefinite if it is truly "
    "singular") {
  CHECK(pair_of(1.0, 1.0).what.semidefinite);
  CHECK(pair_of(1.0, 1.0000000000000002).what.semidefinite);
  CHECK(pair_of(1.0, 0.9999999999999999).shows());
  CHECK(pair_of(1e-15, 1e-30).what.semidefinite);
  CHECK(pair_of(1.000000000000001e-15, 1e-30).shows());
  CHECK(of(30, chain(30, 0.0)).what.semidefinite);
  CHECK(of(30, chain(30, 0x1p-52)).what.semidefinite);
  CHECK(of(30, chain(30, -0x1p-52)).shows());
}

TEST_CASE("only free dofs count for the sign of a matrix, and entries may be from 1e-200 to 1e200") {
  CHECK(of(4, chain(4, -6.0), 0).what.semidefinite);  // only the fixed dof has negative energy
  CHECK(of(4, chain(4, -6.0)).shows());
  const auto coupled = [](double coupling) {
    return of(3, {{0, 0, 1e-200}, {1, 0, coupling}, {1, 1, 1e200}, {2, 2, 3.0}});
  };
  CHECK(coupled(0.999).what.semidefinite);
  CHECK(coupled(1.001).shows());
}

TEST_CASE(
    "random Gram matrices are semidefinite, and most of them become indefinite if the diagonal is slightly "
    "reduced") {
  random_numbers random(16);
  int indefinite = 0;
  for (int round = 0; round < 60; ++round) {
    const int n = random.whole(2, 9);
    const int rank = random.whole(1, n);
    std::vector<std::vector<int>> b(n, std::vector<int>(rank));
    for (auto& row : b)
      for (int& x : row) x = random.whole(-10, 10);
    entries gram;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j)
        gram.push_back({i, j, 1.0 * std::inner_product(b[i].begin(), b[i].end(), b[j].begin(), 0)});
    CHECK(of(n, gram).what.semidefinite);
    if (rank == n) continue;
    for (auto& e : gram)
      if (e.row == e.column) e.value -= 1e-9;
    CHECK(of(n, gram).shows());
    ++indefinite;
  }
  CHECK(indefinite > 20);
}
