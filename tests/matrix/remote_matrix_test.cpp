// A stiffness whose rows are elsewhere gives what one that is here gives. Elsewhere is this process.
#include "contct/matrix/remote_matrix.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

using namespace contct::matrix;

namespace {

/// Whole rows, here. Its diagonal is spoiled once it was given: nothing may depend on it.
class rows_here final : public remote_matrix {
 public:
  explicit rows_here(std::vector<std::vector<double>> k) : k_(std::move(k)) {}
  [[nodiscard]] std::unique_ptr<remote_matrix> copy() override { return std::make_unique<rows_here>(k_); }
  [[nodiscard]] int order() const override { return static_cast<int>(k_.size()); }
  [[nodiscard]] std::vector<double> diagonal() override {
    std::vector<double> d;
    for (std::size_t i = 0; i < k_.size(); ++i) d.push_back(std::exchange(k_[i][i], -1e9));
    return d;
  }
  void scale(std::span<const double> d) override {
    for (std::size_t i = 0; i < k_.size(); ++i)
      for (std::size_t j = 0; j < k_.size(); ++j) k_[i][j] *= d[i] * d[j];
  }
  [[nodiscard]] std::vector<matrix_entry> entries_in(std::span<const char> columns) override {
    std::vector<matrix_entry> found;
    each([&](std::size_t i, std::size_t j, double x) {
      if (columns[j] != 0 && x != 0.0) found.push_back({static_cast<int>(i), static_cast<int>(j), x});
    });
    return found;
  }
  [[nodiscard]] std::vector<long double> times(std::span<const long double> x) override {
    std::vector<long double> y(k_.size());
    each([&](std::size_t i, std::size_t j, double value) { y[i] += value * x[j]; });
    return y;
  }
  [[nodiscard]] std::vector<double> magnitudes(std::span<const double> d) override {
    std::vector<double> y(k_.size());
    each([&](std::size_t i, std::size_t j, double value) { y[i] += std::abs(value * (d[i] * d[j])); });
    return y;
  }
  [[nodiscard]] std::vector<double> half_units(std::span<const double> x) override {
    return {x.begin(), x.end()};
  }
  [[nodiscard]] std::vector<double> sums(std::span<const double> x) override { return {x.begin(), x.end()}; }
  [[nodiscard]] std::unique_ptr<sparse_factor> make_factor() override { return nullptr; }
  [[nodiscard]] std::unique_ptr<remote_truth> truth() override { return nullptr; }

 private:
  template <class Each>
  void each(const Each& off_the_diagonal) {
    for (std::size_t i = 0; i < k_.size(); ++i)
      for (std::size_t j = 0; j < k_.size(); ++j)
        if (i != j) off_the_diagonal(i, j, k_[i][j]);
  }
  std::vector<std::vector<double>> k_;
};

const std::vector<std::vector<double>> entries = {
    {4, -1, 0, 0.5}, {-1, 5, -2, 0}, {0, -2, 6, -3}, {0.5, 0, -3, 7}};

stiffness_matrix here() {
  sparse_matrix k{4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j <= i; ++j)
      if (const double x = entries[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]; x != 0.0)
        k.entries.push_back({i, j, x});
  return columns_of(k);
}

void check_equal(const stiffness_matrix& a, const stiffness_matrix& b) {
  const std::vector<double> x = {1, -2, 0.5, 3};
  std::vector<long double> of_a(4, 10.0L);
  std::vector<long double> of_b = of_a;
  a.subtract_product(std::span<const double>(x), of_a);
  b.subtract_product(std::span<const double>(x), of_b);
  CHECK(of_a == of_b);
  const std::vector<long double> long_x(x.begin(), x.end());
  a.subtract_product(std::span<const long double>(long_x), of_a);
  b.subtract_product(std::span<const long double>(long_x), of_b);
  CHECK(of_a == of_b);
  const std::vector<double> d = {1, 2, 0.5, 4};
  const std::vector<double> diagonal = {1, 2, 3, 4};
  CHECK(a.one_norm(diagonal, d) == b.one_norm(diagonal, d));
  for (std::size_t i = 0; i < 4; ++i) CHECK(a.diagonal(i) == b.diagonal(i));
  const std::vector<char> marked = {0, 1, 0, 1};
  double sum = 0.0;  // of entries that name row and column
  for (const matrix_entry& e : a.entries_in(marked)) sum += (10 * e.row + e.column) * e.value;
  for (const matrix_entry& e : b.entries_in(marked)) sum -= (10 * e.row + e.column) * e.value;
  CHECK(sum == 0.0);
  CHECK(a.entries_in(marked).size() == b.entries_in(marked).size());
}

}  // namespace

TEST_CASE("rows that are elsewhere have the products, norms and entries of rows that are here") {
  stiffness_matrix k = here();
  stiffness_matrix remote = remote_rows(std::make_unique<rows_here>(entries));
  REQUIRE(remote.is_remote());
  REQUIRE_FALSE(remote.is_band());
  CHECK(remote.order() == 4);
  check_equal(k, remote);
  for (stiffness_matrix* a : {&k, &remote}) a->add_to_diagonal(2, 1.5);
  check_equal(k, remote);
  const stiffness_matrix before = remote;
  for (stiffness_matrix* a : {&k, &remote}) a->fix(std::vector<double>{0, 0, 4, 0});
  check_equal(k, remote);
  CHECK(remote.entries_in(std::vector<char>{0, 0, 1, 0}).empty());
  for (stiffness_matrix* a : {&k, &remote}) a->scale(std::vector<double>{2, 1, 1, 0.5});
  check_equal(k, remote);
  CHECK(before.entries_in(std::vector<char>{0, 0, 1, 0}).size() == 2);  // a copy has rows of its own
}
