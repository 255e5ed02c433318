// A plate's stiffness that the ranks share is that of one process: in doubles to the bit, in 32 digits, and
// as what it was made from. Rank 0 of tests/distributed/main.cpp runs it.
#include <cmath>
#include <numeric>

#include "catch.hpp"
#include "contct/certify/scaled_stiffness.hpp"
#include "contct/certify/true_system.hpp"
#include "contct/distributed/ranks.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using certify::true_system;
using distributed::joined_ranks;
using matrix::stiffness_matrix;
using numeric::double_double;

namespace {

/// Wider than high, so that its band has the numbering of its dofs; in pieces of unequal elements.
structure::problem a_plate() {
  return read::parse_problem(R"(
[plate]
x = [0, 0.3, 1, 1.1, 2, 3]
y = [0, 0.7, 1.1, 5, 5.5, 6, 6.1, 9]
E = 210
thickness = 0.3
nu = 0.25
[[support]]
nodes = [1, 8]
fix = ["w", "wx"]
[[support]]
node = 20
spring = { w = 0.1 }
[[contact]]
nodes = [30, 31]
surface = "below"
face = -0.1
stiffness = 3
[[step]]
uniform = -0.1
)",
                             "plate.toml");
}

std::vector<double> waves(int n) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(std::sin(1.7 * i) + 0.1);
  return x;
}

/// The least eigenvalue of S K_A S, from above, by inverse iteration.
double least_by_iteration(const certify::scaled_stiffness& a, const true_system& t) {
  std::vector<double> x = waves(static_cast<int>(t.dofs()));
  double least = 0.0;
  for (int i = 0; i < 50; ++i) {
    std::vector<double> y = x;
    for (std::size_t dof = 0; dof < x.size(); ++dof) y[dof] = t.fixed[dof] != 0 ? 0.0 : x[dof] / a.scale(dof);
    a.solve(y);
    double product = 0.0;
    double norm = 0.0;
    for (std::size_t dof = 0; dof < x.size(); ++dof) {
      y[dof] = t.fixed[dof] != 0 ? 0.0 : y[dof] / a.scale(dof);
      product += x[dof] * y[dof];
      norm += y[dof] * y[dof];
    }
    least = product / norm;
    for (std::size_t dof = 0; dof < x.size(); ++dof) x[dof] = y[dof] / std::sqrt(norm);
  }
  return least;
}

}  // namespace

TEST_CASE("a plate's stiffness on the ranks has the entries of one process's, to the bit") {
  const structure::problem p = a_plate();
  const structure::linear_structure here = path::structure_of(p);
  const structure::linear_structure there = path::structure_of(p, joined_ranks());
  REQUIRE(there.stiffness.is_remote());
  REQUIRE(there.rows.empty());
  const int n = here.dofs();
  std::vector<char> all(static_cast<std::size_t>(n), 1);
  std::vector<std::vector<double>> expected(all.size(), std::vector<double>(all.size()));
  for (const matrix::matrix_entry& e : here.stiffness.entries_in(all))
    expected[static_cast<std::size_t>(e.row)][static_cast<std::size_t>(e.column)] = e.value;
  int compared = 0;
  for (const matrix::matrix_entry& e : there.stiffness.entries_in(all)) {
    const double value = expected[static_cast<std::size_t>(here.row_of(static_cast<std::size_t>(e.row)))]
                                 [static_cast<std::size_t>(here.row_of(static_cast<std::size_t>(e.column)))];
    CHECK(e.value == value);
    ++compared;
  }
  CHECK(compared == static_cast<int>(here.stiffness.entries_in(all).size()));
  CHECK(compared > 1000);
  for (std::size_t dof = 0; dof < all.size(); ++dof)
    CHECK(there.stiffness.diagonal(dof) ==
          here.stiffness.diagonal(static_cast<std::size_t>(here.row_of(dof))));
}

TEST_CASE("products, norms, conditions and scaled copies are those of one process") {
  const structure::problem p = a_plate();
  const structure::linear_structure here = path::structure_of(p);
  const structure::linear_structure there = path::structure_of(p, joined_ranks());
  const int n = here.dofs();
  const std::vector<double> x = waves(n);
  std::vector<double> in_rows(x.size());
  std::vector<double> d(x.size());
  std::vector<double> d_in_rows(x.size());
  std::vector<double> diagonal(x.size());
  for (std::size_t dof = 0; dof < x.size(); ++dof) {
    const auto row = static_cast<std::size_t>(here.row_of(dof));
    in_rows[row] = x[dof];
    diagonal[dof] = there.stiffness.diagonal(dof);
    d[dof] = d_in_rows[row] = 1.0 / std::sqrt(diagonal[dof]);
  }
  for (const bool scaled : {false, true}) {
    stiffness_matrix a = here.stiffness;
    stiffness_matrix b = there.stiffness;
    if (scaled) {
      a.scale(d_in_rows);
      b.scale(d);
    }
    std::vector<long double> of_a(x.size());
    std::vector<long double> of_b(x.size());
    a.subtract_product(std::span<const double>(in_rows), of_a);
    b.subtract_product(std::span<const double>(x), of_b);
    for (std::size_t dof = 0; dof < x.size(); ++dof) {
      const auto row = static_cast<std::size_t>(here.row_of(dof));
      CHECK(static_cast<double>(of_b[dof]) ==
            Approx(static_cast<double>(of_a[row])).epsilon(1e-15).margin(1e-16));
    }
  }
  std::vector<double> own(x.size());
  for (std::size_t dof = 0; dof < x.size(); ++dof)
    own[static_cast<std::size_t>(here.row_of(dof))] = diagonal[dof];
  CHECK(there.stiffness.one_norm(diagonal, d) ==
        Approx(here.stiffness.one_norm(own, d_in_rows)).epsilon(1e-14));
  CHECK(matrix::stiffness_factor(there.stiffness).reciprocal_condition({}) ==
        Approx(matrix::stiffness_factor(here.stiffness).reciprocal_condition({})).epsilon(1e-6));
}

TEST_CASE("in 32 digits the ranks have what one process has, and their bound on the least eigenvalue holds") {
  const structure::problem p = a_plate();
  const structure::linear_structure there = path::structure_of(p, joined_ranks());
  const true_system one = certify::true_system_of(p);
  const true_system many = certify::true_system_of(p, &there.stiffness.others());
  REQUIRE(many.remote);
  certify::long_vector x;
  for (const double w : waves(static_cast<int>(one.dofs()))) x.push_back(double_double(w) / 3);
  certify::long_vector of_one(x.size());
  certify::long_vector of_many(x.size());
  std::vector<double> sizes_of_one(x.size());
  std::vector<double> sizes_of_many(x.size());
  one.add_product(x, of_one, sizes_of_one);
  many.add_product(x, of_many, sizes_of_many);
  for (std::size_t dof = 0; dof < x.size(); ++dof) {
    CHECK(std::abs((of_one[dof] - of_many[dof]).hi) <= 1e-29 * sizes_of_one[dof]);
    CHECK(sizes_of_many[dof] == Approx(sizes_of_one[dof]).epsilon(1e-14));
    CHECK(one.root[dof] == many.root[dof]);
  }
  std::vector<int> rows(x.size());
  std::iota(rows.begin(), rows.end(), 0);
  certify::scaled_stiffness by_band(one, rows, static_cast<int>(x.size()) - 1);
  certify::scaled_stiffness by_ranks(many, rows, std::nullopt);
  for (const std::vector<int>& pairs : {std::vector<int>{}, std::vector<int>{0, 1}}) {
    REQUIRE(by_band.factor(pairs));
    REQUIRE(by_ranks.factor(pairs));
    const double mu = by_ranks.least_eigenvalue();
    const double least = least_by_iteration(by_ranks, one);
    CHECK(mu < 0.76 * least);  // it is tried at 0.75 of an estimate
    CHECK(mu > 0.74 * least);
    std::vector<double> a = waves(static_cast<int>(x.size()));
    for (std::size_t dof = 0; dof < a.size(); ++dof) a[dof] *= one.fixed[dof] != 0 ? 0.0 : 1.0;
    std::vector<double> b = a;
    by_band.solve(a);
    by_ranks.solve(b);  // by the factor without a shift
    for (std::size_t dof = 0; dof < a.size(); ++dof)
      CHECK(b[dof] == Approx(a[dof]).epsilon(1e-7).margin(1e-9));
  }
}

TEST_CASE("a plate whose stiffness is not finite is refused once, and the ranks go on") {
  structure::problem p = a_plate();
  std::get<structure::plate>(p.geometry.kind).x = {0, 1e-200, 1, 2, 3, 4};
  CHECK_THROWS_WITH(path::structure_of(p, joined_ranks()),
                    Catch::Matchers::Contains("is not a finite number"));
  CHECK(path::structure_of(a_plate(), joined_ranks()).dofs() == 144);
}
