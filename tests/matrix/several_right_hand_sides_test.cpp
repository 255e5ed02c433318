#include "contct/matrix/several_right_hand_sides.hpp"

#include "catch.hpp"

using namespace contct::app;

namespace {

using entries = std::array<double, block_width>;

entries counted_from(double first) {
  entries row{};
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = first + static_cast<double>(i);
  return row;
}

}  // namespace

TEST_CASE("every right-hand side of a row has the same multiple of another row subtracted") {
  const entries x = counted_from(1);
  const entries y = counted_from(100);
  const entries start = counted_from(1000);
  entries row = start;
  subtract_from(row.data(), 2.0, block_row::load(x.data()));
  for (std::size_t i = 0; i < row.size(); ++i) CHECK(row[i] == start[i] - 2 * x[i]);
  subtract_from(row.data(), 1.0, block_row::load(x.data()), -3.0, block_row::load(y.data()));
  for (std::size_t i = 0; i < row.size(); ++i) CHECK(row[i] == start[i] - 3 * x[i] + 3 * y[i]);
}

TEST_CASE("a row is divided by the pivot after a sum is subtracted") {
  entries row = counted_from(5);
  block_row sum{};
  sum.add(2.0, block_row::load(row.data()));
  divide(row.data(), -4.0, sum);
  for (std::size_t i = 0; i < row.size(); ++i) CHECK(row[i] == counted_from(5)[i] / 4);
  entries returned{};
  divide(row.data(), 0.5).store(returned.data());
  CHECK(returned == row);
  CHECK(row[7] == 6.0);
}
