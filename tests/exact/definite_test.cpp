// Semidefinite or not, decided without rounding.
#include "contct/exact/definite.hpp"

#include <numeric>
#include <random>

#include "catch.hpp"

using namespace contct::exact;

namespace {

constexpr std::int64_t plenty = std::int64_t{1} << 30;

struct matrix {
  contct::exact::sparse_rows rows;

  explicit matrix(std::size_t n) : rows(n) {}
  void put(int i, int j, const rational& x) {
    rows[static_cast<std::size_t>(i)][j] = x;
    rows[static_cast<std::size_t>(j)][i] = x;
  }

  [[nodiscard]] std::optional<negative_work> negative(std::vector<char> fixed = {}) const {
    std::vector<int> place(rows.size());
    std::iota(place.begin(), place.end(), 0);
    fixed.resize(rows.size());
    return find_negative_work(rows, fixed, place, plenty);
  }

  /// The work on a motion, by a sum of its own.
  [[nodiscard]] rational work_on(const vector& x) const {
    rational sum;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const auto& [j, k] : rows[i]) sum += x[i] * k * x[static_cast<std::size_t>(j)];
    return sum;
  }

  void check_shown(const std::optional<negative_work>& shown) const {
    REQUIRE(shown.has_value());
    CHECK(shown->work < 0);
    CHECK(shown->work == work_on(shown->motion));
  }
};

rational tiny(unsigned digits) {
  return {integer(1), boost::multiprecision::pow(integer(10), digits)};
}

/// 2 x 2 with the determinant `d`.
matrix pair_of(const rational& d) {
  matrix m(2);
  m.put(0, 0, 1);
  m.put(1, 0, 1);
  m.put(1, 1, 1 + d);
  return m;
}

/// A chain of springs on a ground of stiffness `ground` at every dof.
matrix chain(int n, const rational& ground) {
  matrix m(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) m.put(i, i, (i == 0 || i + 1 == n ? 1 : 2) + ground);
  for (int i = 0; i + 1 < n; ++i) m.put(i, i + 1, -1);
  return m;
}

}  // namespace

TEST_CASE("matrices that doubles cannot tell from singular ones are decided, to hundreds of digits") {
  for (const unsigned digits : {5U, 20U, 60U, 300U, 1000U}) {
    CHECK_FALSE(pair_of(tiny(digits)).negative().has_value());
    const matrix indefinite = pair_of(-tiny(digits));
    indefinite.check_shown(indefinite.negative());
    CHECK_FALSE(chain(30, tiny(digits)).negative().has_value());
    const matrix loose = chain(30, -tiny(digits));
    loose.check_shown(loose.negative());
  }
}

TEST_CASE("semidefinite is allowed: a free chain, and numbers that cancel exactly") {
  CHECK_FALSE(pair_of(0).negative().has_value());
  CHECK_FALSE(chain(30, 0).negative().has_value());
}

TEST_CASE("negative work at dofs that supports fix does not count") {
  matrix m = chain(4, 0);
  m.put(0, 0, -5);
  CHECK_FALSE(m.negative({1, 0, 0, 0}).has_value());
  m.check_shown(m.negative());
}

TEST_CASE("a diagonal of 0 beside an entry, and negative ones, are shown by one dof or two") {
  matrix m(3);
  m.put(0, 0, 1);
  m.put(1, 1, 2);
  m.put(2, 2, -1);
  m.check_shown(m.negative());
  m.put(2, 2, rational(1, 1000));
  m.put(1, 2, 1);
  m.check_shown(m.negative());
}

TEST_CASE("numbers of all sizes are scaled: 1e-300 beside 1e300") {
  matrix m(3);
  m.put(0, 0, tiny(300));
  m.put(1, 1, 1 / tiny(300));
  m.put(0, 1, rational(999, 1000));
  m.put(2, 2, 3);
  CHECK_FALSE(m.negative().has_value());
  m.put(0, 1, rational(1001, 1000));
  m.check_shown(m.negative());
}

TEST_CASE("random Gram matrices are semidefinite, and less a little of the diagonal they are not") {
  std::mt19937_64 random(16);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same matrices every time
  std::size_t definite = 0;
  std::size_t indefinite = 0;
  for (int round = 0; round < 60; ++round) {
    const int n = 2 + static_cast<int>(random() % 8);
    const int rank = 1 + static_cast<int>(random() % static_cast<unsigned>(n));
    std::vector<std::vector<int>> b(static_cast<std::size_t>(n),
                                    std::vector<int>(static_cast<std::size_t>(rank)));
    for (auto& row : b)
      for (int& x : row) x = static_cast<int>(random() % 21) - 10;
    matrix m(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        const auto& left = b[static_cast<std::size_t>(i)];
        m.put(i, j, std::inner_product(left.begin(), left.end(), b[static_cast<std::size_t>(j)].begin(), 0));
      }
    CHECK_FALSE(m.negative().has_value());
    ++definite;
    if (rank == n) continue;
    for (int i = 0; i < n; ++i) m.put(i, i, m.rows[static_cast<std::size_t>(i)].at(i) - tiny(25));
    m.check_shown(m.negative());
    ++indefinite;
  }
  CHECK(definite == 60);
  CHECK(indefinite > 20);
}

TEST_CASE("what would take too much memory to decide is refused with the figure") {
  const matrix m = pair_of(tiny(300));
  const std::vector<char> fixed(2);
  const std::vector<int> place = {0, 1};
  CHECK_THROWS_WITH(
      find_negative_work(m.rows, fixed, place, 200),
      Catch::Matchers::Contains("256 would take") || Catch::Matchers::Contains("would take 1 MiB"));
}

TEST_CASE("a pivot that is exactly 0 above an entry that is not is refused as indefinite") {
  matrix m(3);
  for (int i = 0; i < 3; ++i) m.put(i, i, 1);
  m.put(0, 1, 1);
  m.put(1, 2, rational(1, 2));
  CHECK_THROWS_WITH(m.negative(), Catch::Matchers::Contains("indefinite"));
}
