#include "contct/matrix/supernodal_solve.hpp"

#include <vector>

#include "catch.hpp"
#include "contct/matrix/several_right_hand_sides.hpp"
#include "contct/numeric/random.hpp"

using namespace contct::app;

TEST_CASE("supernodes of any width, with rows far below, are solved as the matrix that they make") {
  // Columns 0 and 1 with rows 0, 1, 3; column 2 with rows 2, 4; columns 3, 4.
  const std::vector<int> columns = {0, 2, 3, 5};
  const std::vector<int> row_places = {0, 3, 5, 7};
  const std::vector<int> entry_places = {0, 6, 8};
  const std::vector<int> rows = {0, 1, 3, 2, 4, 3, 4};
  const std::vector<double> entries = {2, 1, 3, 0, 4, 5, 6, 7, 8, 9, 0, 10};
  const double l[5][5] = {
      {2, 0, 0, 0, 0}, {1, 4, 0, 0, 0}, {0, 0, 6, 0, 0}, {3, 5, 0, 8, 0}, {0, 0, 7, 9, 10}};
  random_numbers random(8);
  std::vector<double> x(5 * block_width);
  for (double& entry : x) entry = random.unit() - 0.5;
  for (std::size_t i = 0; i < 5; ++i) x[i * block_width + 3] = 0.0;  // one right-hand side of nothing
  std::vector<double> b(x.size());
  for (std::size_t row = 0; row < 5; ++row)
    for (std::size_t column = 0; column < 5; ++column)
      for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t i = 0; i < block_width; ++i)
          b[row * block_width + i] += l[row][k] * l[column][k] * x[column * block_width + i];
  solve_block({columns, row_places, entry_places, rows, entries}, b);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(b[i] == Approx(x[i]).epsilon(1e-12).margin(1e-13));
}
