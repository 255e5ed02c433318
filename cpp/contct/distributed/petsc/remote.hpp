// Matrices of the ranks in the hands of rank 0: each function is an order to all.
#pragma once

#include <memory>
#include <stdexcept>

#include "contct/distributed/petsc/orders.hpp"
#include "contct/matrix/remote_matrix.hpp"
#include "contct/matrix/sparse_factor.hpp"

namespace contct::distributed::petsc {

/// A distributed matrix in the hands of rank 0.
class remote_factor final : public matrix::sparse_factor {
 public:
  remote_factor(commander& all, int number, const matrix::sparse_columns& a);
  /// Of a stiffness (to_factor) or of one in 32 digits (truth_to_factor), D K D.
  remote_factor(commander& all, int number, verb how, int from, std::span<const double> d);
  ~remote_factor() override;
  [[nodiscard]] std::int64_t bytes() const override { return static_cast<std::int64_t>(bytes_); }
  [[nodiscard]] bool factor(std::span<const double> diagonal) override;
  void solve(std::span<double> b) override;
  void solve_units(std::span<const int> rows, std::vector<double>& x) override;
  [[nodiscard]] bool solve_units_at(std::span<const int> rows, std::span<const int> at,
                                    std::vector<double>& x) override;
  [[nodiscard]] bool update(int /*row*/, double /*k*/, bool /*add*/) override { return false; }
  [[nodiscard]] matrix::sparse_columns lower() const override { throw no_such(); }
  [[nodiscard]] const std::vector<int>& places() const override { throw no_such(); }
  [[nodiscard]] double flops() const override { return flops_; }
  [[nodiscard]] double most_entries() const override;

 private:
  [[nodiscard]] static std::logic_error no_such() {
    return std::logic_error("a distributed factor cannot be read");
  }
  remote_factor(commander& all, const command& made_by, const given& g);

  commander& all_;
  int number_;
  double flops_, bytes_;
};

/// A stiffness in 32 digits, likewise.
class remote_decimals final : public matrix::remote_truth {
 public:
  remote_decimals(commander& all, int number) : all_(all), number_(number) {}
  ~remote_decimals() override;
  [[nodiscard]] std::vector<double_double> diagonal() override;
  [[nodiscard]] std::vector<double_double> times(std::span<const double_double> x) override;
  [[nodiscard]] std::vector<double> sums(std::span<const double> x) override;
  [[nodiscard]] int widest_row() override;
  [[nodiscard]] std::unique_ptr<matrix::sparse_factor> make_factor(std::span<const double> d) override;

 private:
  commander& all_;
  int number_;
};

/// A stiffness in doubles, likewise.
class remote_stiffness final : public matrix::remote_matrix {
 public:
  remote_stiffness(commander& all, int number, int order) : all_(all), number_(number), order_(order) {}
  ~remote_stiffness() override;
  [[nodiscard]] std::unique_ptr<matrix::remote_matrix> copy() override;
  [[nodiscard]] int order() const override { return order_; }
  [[nodiscard]] std::vector<double> diagonal() override;
  void scale(std::span<const double> d) override;
  [[nodiscard]] std::vector<matrix::matrix_entry> entries_in(std::span<const char> columns) override;
  [[nodiscard]] std::vector<long double> times(std::span<const long double> x) override;
  [[nodiscard]] std::vector<double> magnitudes(std::span<const double> d) override {
    return in_doubles(verb::magnitudes, d);
  }
  [[nodiscard]] std::vector<double> half_units(std::span<const double> x) override {
    return in_doubles(verb::half_units, x);
  }
  [[nodiscard]] std::vector<double> sums(std::span<const double> x) override {
    return in_doubles(verb::sums, x);
  }
  [[nodiscard]] std::unique_ptr<matrix::sparse_factor> make_factor() override;
  [[nodiscard]] std::unique_ptr<matrix::remote_truth> truth() override;

 private:
  [[nodiscard]] std::vector<double> in_doubles(verb what, std::span<const double> x);
  commander& all_;
  int number_, order_;
};

}  // namespace contct::distributed::petsc
