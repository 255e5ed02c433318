// Only where CHOLMOD is built in.
#include "contct/matrix/sparse_factor.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "catch.hpp"
#include "contct/matrix/cholesky.hpp"
#include "support/matrices.hpp"

using namespace contct::app;

namespace {

constexpr int unknowns = 40;

std::vector<double> diagonal_of(const band_matrix& k) {
  return stiffness_matrix(k).diagonal_with({});
}

/// The solution by LAPACK.
std::vector<double> solution(band_matrix k, std::vector<double> b) {
  REQUIRE(factor(k));
  solve_with(k, b);
  return b;
}

void check_solves(sparse_factor& f, const band_matrix& k) {
  const std::vector<double> b = random_vector(unknowns, 3);
  std::vector<double> x = b;
  f.solve(x);
  const std::vector<double> expected = solution(k, b);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(x[i] == Approx(expected[i]).epsilon(1e-11).margin(1e-14));
}

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

}  // namespace

TEST_CASE("a sparse factor solves as LAPACK does, again with another diagonal") {
  band_matrix k = random_band(unknowns, 7, 1);
  const auto f = sparse_factor::make(columns_of(k));
  REQUIRE(f->factor(diagonal_of(k)));
  check_solves(*f, k);
  band_matrix stiffer = k;
  stiffer.at(4, 4) += 3.0;
  REQUIRE(f->factor(diagonal_of(stiffer)));
  check_solves(*f, stiffer);
}

TEST_CASE("a factor is L with L L' the matrix, in its own order") {
  const band_matrix k = random_band(unknowns, 7, 4);
  const auto f = sparse_factor::make(columns_of(k));
  REQUIRE(f->factor(diagonal_of(k)));
  check_solves(*f, k);
  const sparse_columns l = f->lower();
  REQUIRE(l.order() == unknowns);
  std::vector<std::vector<double>> product(unknowns, std::vector<double>(unknowns));
  for (int column = 0; column < unknowns; ++column) {
    const auto first = l.rows.begin() + l.starts[column];
    const auto last = l.rows.begin() + l.starts[column + 1];
    CHECK(*first == column);
    CHECK(std::is_sorted(first, last));
    for (int i = l.starts[column]; i < l.starts[column + 1]; ++i)
      for (int j = l.starts[column]; j < l.starts[column + 1]; ++j)
        product[l.rows[i]][l.rows[j]] += l.values[i] * l.values[j];
  }
  const std::vector<int>& places = f->places();
  for (int row = 0; row < unknowns; ++row)
    for (int column = std::max(0, row - 7); column <= row; ++column)
      CHECK(product[places[row]][places[column]] == Approx(k.at(row, column)).margin(1e-13));
}

TEST_CASE("a matrix that is not positive definite has no factor, and a better diagonal has one") {
  const band_matrix k = random_band(unknowns, 7, 4);
  const auto f = sparse_factor::make(columns_of(k));
  std::vector<double> diagonal = diagonal_of(k);
  diagonal[20] = -1.0;
  CHECK_FALSE(f->factor(diagonal));
  CHECK(f->factor(diagonal_of(k)));
  CHECK(f->bytes() >= static_cast<std::int64_t>(sizeof(double)) * unknowns);
  CHECK(f->flops() > 0.0);
}

TEST_CASE("several right-hand sides are solved for at once, and one after them") {
  const band_matrix k = random_band(unknowns, 7, 5);
  const auto f = sparse_factor::make(columns_of(k));
  REQUIRE(f->factor(diagonal_of(k)));
  std::vector<double> b = random_vector(3 * unknowns, 6);
  const std::vector<double> given = b;
  f->solve(b);
  for (std::size_t first = 0; first < b.size(); first += unknowns) {
    const auto begin = given.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<double> expected = solution(k, {begin, begin + unknowns});
    for (std::size_t row = 0; row < expected.size(); ++row)
      CHECK(b[first + row] == Approx(expected[row]).epsilon(1e-11).margin(1e-14));
  }
  check_solves(*f, k);
}

TEST_CASE("CHOLMOD factors without threads of OpenMP") {
  constexpr int many = 3000;
  const band_matrix k = random_band(many, 20, 5);
  const auto f = sparse_factor::make(columns_of(k));
  const std::ptrdiff_t before = threads_of_this_process();
  REQUIRE(before >= 1);
  REQUIRE(f->factor(diagonal_of(k)));
  CHECK(threads_of_this_process() == before);
}
