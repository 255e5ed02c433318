#include <algorithm>

#include "catch.hpp"
#include "contct/matrix/stiffness_matrix.hpp"
#include "support/matrices.hpp"

using namespace contct;

TEST_CASE("the rows of a chain in random order are reordered to a band with one subdiagonal") {
  constexpr int n = 23;
  sparse_matrix chain{n, {}};
  const auto shuffled = [](int i) { return i * 7 % n; };
  for (int i = 0; i < n; ++i) {
    chain.entries.push_back({shuffled(i), shuffled(i), 2.0});
    if (i + 1 == n) break;
    const int a = shuffled(i);
    const int b = shuffled(i + 1);
    chain.entries.push_back({std::max(a, b), std::min(a, b), -1.0});
  }
  REQUIRE(subdiagonals_of(chain, {}) > 1);
  std::vector<int> rows = rows_for_small_band(chain);
  CHECK(subdiagonals_of(chain, rows) == 1);
  std::sort(rows.begin(), rows.end());
  for (int i = 0; i < n; ++i) CHECK(rows[i] == i);  // each row once
}

TEST_CASE("if no other order of rows makes the band narrower, the order is kept") {
  const sparse_matrix pair{2, {{0, 0, 1.0}, {1, 0, -0.5}, {1, 1, 1.0}}};
  CHECK(rows_for_small_band(pair).empty());
  const sparse_matrix diagonal{3, {{0, 0, 1.0}, {1, 1, 1.0}, {2, 2, 1.0}}};
  CHECK(rows_for_small_band(diagonal).empty());
}
