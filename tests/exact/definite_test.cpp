// Tests the exact decision whether a matrix is positive semidefinite.
#include <random>

#include "catch.hpp"
#include "contct/exact/exact_means.hpp"

using namespace contct;
using contct::assembled;

namespace {

using entries = std::vector<contct::matrix_entry>;

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
  assembled a;
  a.stiffness = {n, lower, {}};
  for (int row = 0; row < n; ++row) a.rows.push_back(row);
  contct::problem p;
  p.geometry = {a};
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

TEST_CASE("a matrix counts as semidefinite if only displacements of fixed dofs have negative energy") {
  CHECK(of(4, chain(4, -6.0), 0).what.semidefinite);
  CHECK(of(4, chain(4, -6.0)).shows());
}

TEST_CASE("a matrix with entries from 1e-200 to 1e200 is classified correctly as semidefinite") {
  const auto coupled = [](double coupling) {
    return of(3, {{0, 0, 1e-200}, {1, 0, coupling}, {1, 1, 1e200}, {2, 2, 3.0}});
  };
  CHECK(coupled(0.999).what.semidefinite);
  CHECK(coupled(1.001).shows());
}

TEST_CASE(
    "random Gram matrices are semidefinite, and most of them become indefinite if the diagonal is slightly "
    "reduced") {
  std::mt19937_64 random(16);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same matrices every time
  int indefinite = 0;
  for (int round = 0; round < 60; ++round) {
    const int n = 2 + static_cast<int>(random() % 8);
    const int rank = 1 + static_cast<int>(random() % static_cast<unsigned>(n));
    std::vector<std::vector<int>> b(n, std::vector<int>(rank));
    for (auto& row : b)
      for (int& x : row) x = static_cast<int>(random() % 21) - 10;
    entries gram;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        double sum = 0.0;
        for (int k = 0; k < rank; ++k) sum += b[i][k] * b[j][k];
        gram.push_back({i, j, sum});
      }
    CHECK(of(n, gram).what.semidefinite);
    if (rank == n) continue;
    for (auto& e : gram)
      if (e.row == e.column) e.value -= 1e-9;
    CHECK(of(n, gram).shows());
    ++indefinite;
  }
  CHECK(indefinite > 20);
}
