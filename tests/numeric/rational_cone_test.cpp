// Cones against all choices of as many parts as there are equations, which is all that a cone needs
// (Caratheodory).
#include "contct/numeric/rational_cone.hpp"

#include <array>

#include "catch.hpp"
#include "contct/numeric/random.hpp"

using contct::numeric::is_in_cone;
using contct::numeric::rational;
using numbers = std::vector<rational>;

namespace {

rational determinant(const numbers& a, const numbers& b, const numbers& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Cramer's rule for every three parts, two parts and a vector beside them, and so on.
bool by_every_choice(const numbers& sum, const std::vector<numbers>& parts) {
  if (sum == numbers(3)) return true;
  const auto with_units = [&] {
    std::vector<std::pair<numbers, bool>> all;  // units complete a choice, with a share of 0
    for (const numbers& p : parts) all.emplace_back(p, true);
    for (std::size_t i = 0; i < 3; ++i) {
      numbers unit(3);
      unit[i] = 1;
      all.emplace_back(unit, false);
    }
    return all;
  }();
  for (const auto& [a, a_counts] : with_units)
    for (const auto& [b, b_counts] : with_units)
      for (const auto& [c, c_counts] : with_units) {
        const rational whole = determinant(a, b, c);
        if (whole == 0) continue;
        const std::array<rational, 3> share = {determinant(sum, b, c) / whole, determinant(a, sum, c) / whole,
                                               determinant(a, b, sum) / whole};
        const std::array<bool, 3> counts = {a_counts, b_counts, c_counts};
        bool right = true;
        for (std::size_t i = 0; i < 3; ++i) right = right && (counts[i] ? share[i] >= 0 : share[i] == 0);
        if (right) return true;
      }
  return false;
}

}  // namespace

TEST_CASE("two faces under a beam carry what stands between them, and nothing else") {
  const std::vector<numbers> two = {{1, -1}, {1, 1}};
  CHECK(is_in_cone({2, 0}, two));
  CHECK(is_in_cone({1, 1}, two));  // over one of them
  CHECK_FALSE(is_in_cone({1, rational(1000000001, 1000000000)}, two));
  CHECK_FALSE(is_in_cone({-2, 0}, two));
  CHECK(is_in_cone({0, 0}, {}));
  CHECK_FALSE(is_in_cone({0, 1}, {}));
  CHECK(is_in_cone({}, {}));
}

TEST_CASE("in a cone or not, as every choice of its parts has it") {
  contct::numeric::random_numbers random(17);
  int inside = 0;
  int tried = 0;
  for (; tried < 3000; ++tried) {
    const auto draw = [&] { return numbers{random.whole(-3, 3), random.whole(-3, 3), random.whole(-3, 3)}; };
    std::vector<numbers> parts(static_cast<std::size_t>(random.whole(0, 5)));
    for (numbers& p : parts) p = draw();
    const numbers sum = draw();
    const bool expected = by_every_choice(sum, parts);
    inside += expected ? 1 : 0;
    REQUIRE(is_in_cone(sum, parts) == expected);
  }
  CHECK(inside > 300);
  CHECK(tried - inside > 300);
}

TEST_CASE("of thousands of parts in a square, its edge is the cone's to the thirtieth digit") {
  std::vector<numbers> parts;
  for (int i = -30; i <= 30; ++i)
    for (int j = -30; j <= 30; ++j) parts.push_back({1, rational(i, 30), rational(j, 30)});
  rational tiny = 1;
  for (int i = 0; i < 30; ++i) tiny /= 10;
  const rational third(1, 3);
  for (const rational& along : {rational(0), third, rational(1)}) {
    CHECK(is_in_cone({2, 2, 2 * along}, parts));  // on the edge
    CHECK(is_in_cone({1, rational(1 - tiny), along}, parts));
    CHECK_FALSE(is_in_cone({1, rational(1 + tiny), along}, parts));
    CHECK_FALSE(is_in_cone({1, along, rational(-1 - tiny)}, parts));
  }
  CHECK_FALSE(is_in_cone({rational(-tiny), 0, 0}, parts));
  CHECK(is_in_cone({tiny, 0, 0}, parts));
}
