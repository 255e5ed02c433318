#include "contct/matrix/cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "catch.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

extern "C" void dpbcon_(const char* uplo, const int* n, const int* kd, const double* ab, const int* ldab,
                        const double* anorm, double* rcond, double* work, int* iwork, int* info,
                        std::size_t uplo_length);

namespace {

/// Returns a simply supported beam of `n` elements of length h.
linear_structure simple_span(int n, double h) {
  const std::vector<support> ends = {{0, 0, true}, {n, 0, true}};
  return build(even_beam(n * h, n, 1.0), ends, {});
}

double rcond_of(const linear_structure& s) {
  return stiffness_factor(s.stiffness).reciprocal_condition({});
}

}  // namespace

TEST_CASE("a band factor solves K x = b, and gives the x from which b was computed") {
  band_matrix a(5, 2);
  for (int j = 0; j < 5; ++j) {
    a.add(j, j, 10.0 + j);
    if (j + 1 < 5) a.add(j + 1, j, -3.0);
    if (j + 2 < 5) a.add(j + 2, j, 1.5);
  }
  const std::vector<double> x = {1, -2, 3, -4, 5};
  std::vector<double> b = product(a, x);
  REQUIRE(factor(a));
  solve_with(a, b);
  for (std::size_t i = 0; i < 5; ++i) CHECK(b[i] == Approx(x[i]).epsilon(1e-14));
}

TEST_CASE("the condition number is that of the equilibrated matrix, and does not depend on units") {
  const double metres = rcond_of(simple_span(10, 1.0));
  const double tiny = rcond_of(simple_span(10, 1e-9));
  CHECK(metres == Approx(tiny).epsilon(1e-6));
  CHECK(metres > 1e-6);
  CHECK(metres < 1e-3);
}

TEST_CASE("the condition number equals the estimate that dpbcon of LAPACK gives") {
  for (const int n : {1, 2, 7, 50, 400}) {
    const linear_structure s = simple_span(n, 1.0);
    const double ours = rcond_of(s);
    // dpbcon gets the same scaled matrix.
    stiffness_matrix scaled = s.stiffness;
    std::vector<double> d;
    for (const double entry : scaled.diagonal_with({})) d.push_back(1.0 / std::sqrt(entry));
    const double norm = scaled.one_norm(scaled.diagonal_with({}), d);
    scaled.scale(d);
    band_matrix& a = scaled.band();
    REQUIRE(factor(a));
    const int order = a.order();
    const int kd = 3;
    const int ldab = 4;
    int info = -1;
    double rcond = 0.0;
    std::vector<double> work(3 * d.size());
    std::vector<int> iwork(d.size());
    dpbcon_("L", &order, &kd, a.data(), &ldab, &norm, &rcond, work.data(), iwork.data(), &info, 1);
    REQUIRE(info == 0);
    INFO(n << " elements");
    CHECK(ours == Approx(rcond).epsilon(1e-6));
  }
}

TEST_CASE("the condition number of an equilibrated 2 by 2 matrix is exact") {
  band_matrix a(2, 1);  // scaled [[1, .5], [.5, 1]]: norm 1.5, its inverse 2
  a.add(0, 0, 4.0);
  a.add(1, 1, 25.0);
  a.add(1, 0, 5.0);
  const stiffness_matrix k(a);
  CHECK(stiffness_factor(k).reciprocal_condition({}) == Approx(1.0 / 3.0).epsilon(1e-14));
}

TEST_CASE("a span of n elements loses correct digits as n^4, and for n = 5000 at most one digit remains") {
  const double at_10 = rcond_of(simple_span(10, 1.0));
  const double at_100 = rcond_of(simple_span(100, 1.0));
  CHECK(at_10 / at_100 == Approx(1e4).epsilon(0.5));
  CHECK(digits_left(at_10) >= 10);
  CHECK(digits_left(rcond_of(simple_span(5000, 1.0))) <= 1);
}

TEST_CASE("the number of correct digits is from 0 to 15 for any condition number") {
  CHECK(digits_left(0.0) == 0);
  CHECK(digits_left(1e-30) == 0);
  CHECK(digits_left(1.0) == 15);
}

TEST_CASE("LAPACK is identified by a version and the library that contains dpbtrf") {
  const std::string identity = lapack_identity();
  CHECK(identity.rfind("LAPACK 3.", 0) == 0);
  const std::size_t comma = identity.find(", ");
  REQUIRE(comma != std::string::npos);
  CHECK(identity.find('/') == std::string::npos);  // the library is named without its folder
  CHECK(identity.size() > comma + 2);
}
