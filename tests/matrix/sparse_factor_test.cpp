// Tests sparse factors; compiled only with CHOLMOD.
#include "contct/matrix/sparse_factor.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "catch.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

constexpr int unknowns = 40;

std::vector<double> diagonal_of(const band_matrix& k) {
  return stiffness_matrix(k).diagonal_with({});
}

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

}  // namespace

TEST_CASE(
    "the product of the sparse factor L and its transpose is the matrix in the factor's order of rows") {
  const band_matrix k = random_band(unknowns, 7, 4);
  const auto f = sparse_factor::make(columns_of(k));
  REQUIRE(f->factor(diagonal_of(k)));
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

TEST_CASE("CHOLMOD factors a matrix without creating OpenMP threads") {
  constexpr int many = 3000;
  const band_matrix k = random_band(many, 20, 5);
  const auto f = sparse_factor::make(columns_of(k));
  const std::ptrdiff_t before = threads_of_this_process();
  REQUIRE(before >= 1);
  REQUIRE(f->factor(diagonal_of(k)));
  CHECK(threads_of_this_process() == before);
}
