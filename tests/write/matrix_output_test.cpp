// Stiffness matrices as files.
#include "contct/write/matrix_output.hpp"

#include <stdexcept>

#include "catch.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/petsc_matrix.hpp"
#include "support/equal_matrices.hpp"
#include "support/matrices.hpp"
#include "support/petsc_bytes.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

std::string matrix_market(const sparse_matrix& a) {
  std::string text;
  output_file out(&text);
  (void)write_matrix_market(a, out);
  return text;
}

std::string petsc(const sparse_matrix& a) {
  std::string bytes;
  output_file out(&bytes);
  (void)write_petsc_matrix(a, out);
  return bytes;
}

}  // namespace

TEST_CASE(
    "a matrix is written with all its entries in PETSc's binary, with the lower triangle in Matrix Market") {
  const sparse_matrix a{3, {{0, 0, 4}, {1, 0, -1}, {1, 1, 4.5}, {2, 1, -0.1}}};
  CHECK(petsc(a) == petsc_bytes({{{0, 4}, {1, -1}}, {{0, -1}, {1, 4.5}, {2, -0.1}}, {{1, -0.1}, {2, 0}}}));
  CHECK(matrix_market(a) ==
        "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 4\n2 1 -1\n2 2 4.5\n3 2 -0.1\n3 3 0\n");
}

TEST_CASE("random doubles come back from both formats to the bit, however large or small") {
  random_numbers random(7);
  sparse_matrix a{200, {}};
  for (int column = 0; column < a.order; ++column) {
    for (int row = column; row < a.order; ++row) {
      const double value = std::ldexp(random.unit() + 0x1p-60, random.whole(-1000, 1000));
      if (row == column || random.chance(0.1))
        a.entries.push_back({row, column, row == column ? value : -value});
    }
  }
  CHECK(equal(parse_symmetric(matrix_market(a), "K"), a));
  CHECK(equal(parse_petsc_matrix(petsc(a), "K"), a));
}

TEST_CASE("a body of springs comes back from both formats, larger than what is collected at once") {
  std::vector<std::array<double, 3>> points;
  for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0})
    for (const auto& at : box_at(x * 1.7)) points.push_back(at);
  const sparse_matrix a = braced(points, 1234.5);
  REQUIRE(a.entries.size() > 5000);
  CHECK(equal(parse_symmetric(matrix_market(a), "K"), a));
  CHECK(equal(parse_petsc_matrix(petsc(a), "K"), a));
}

TEST_CASE("more entries than PETSc's binary counts are refused before anything is written") {
  const sparse_matrix a{2, {{0, 0, 2}, {1, 0, -1}, {1, 1, 2}}};
  std::string bytes;
  output_file out(&bytes);
  CHECK(write_petsc_matrix(a, out, 4) == 4);
  bytes.clear();
  CHECK_THROWS_WITH(write_petsc_matrix(a, out, 3),
                    Contains("found 4 entries in both triangles; allowed in PETSc's binary: at most 3"));
  CHECK(bytes.empty());
}
