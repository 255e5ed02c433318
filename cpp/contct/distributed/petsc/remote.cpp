#include "contct/distributed/petsc/remote.hpp"

#include <algorithm>
#include <new>
#include <numeric>
#include <string>

namespace contct::distributed::petsc {

remote_factor::remote_factor(commander& all, int number, const matrix::sparse_columns& a)
    : remote_factor(all, {verb::make, number, 0, a.order()}, {.matrix = &a}) {}

remote_factor::remote_factor(commander& all, int number, verb how, int from, std::span<const double> d)
    : remote_factor(all, {how, number, from}, {.doubles = d}) {}

remote_factor::remote_factor(commander& all, const command& made_by, const given& g)
    : all_(all),
      number_((static_cast<void>(all.command_all(made_by, g)), made_by.matrix)),
      flops_(all_.at(number_).own().flops()),
      bytes_(all_.at(number_).own().bytes()) {}

double remote_factor::most_entries() const {
  return all_.at(number_).own().entries();
}

remote_factor::~remote_factor() {
  (void)all_.command_all({verb::drop, number_}, {});
}

bool remote_factor::factor(std::span<const double> diagonal) {
  std::vector<double> copy(diagonal.begin(), diagonal.end());
  const auto found =
      static_cast<factored>(all_.command_all({verb::factor, number_}, {.vector = copy.data()}));
  if (found == factored::no_memory) throw std::bad_alloc();
  if (found != factored::failed) return found == factored::yes;
  const auto [code, detail] = all_.at(number_).own().mumps_said();
  throw std::runtime_error("MUMPS cannot factor the stiffness: INFOG(1) = " + std::to_string(code) +
                           ", INFOG(2) = " + std::to_string(detail));
}

void remote_factor::solve(std::span<double> b) {
  (void)all_.command_all({verb::solve, number_}, {.vector = b.data()});
}

bool remote_factor::solve_units_at(std::span<const int> rows, std::span<const int> at,
                                   std::vector<double>& x) {
  if (!all_.at(number_).watches(at)) {
    std::vector<int> watched(at.begin(), at.end());
    (void)all_.command_all({verb::watch, number_, 0, static_cast<int>(watched.size())}, {.rows = &watched});
  }
  command c{verb::solve_units, number_, 0, static_cast<int>(rows.size())};
  std::copy(rows.begin(), rows.end(), c.units.begin());
  (void)all_.command_all(c, {.solutions = &x});
  return true;
}

void remote_factor::solve_units(std::span<const int> rows, std::vector<double>& x) {
  std::vector<int> all(static_cast<std::size_t>(all_.at(number_).order()));
  std::iota(all.begin(), all.end(), 0);
  (void)solve_units_at(rows, all, x);
}

remote_decimals::~remote_decimals() {
  (void)all_.command_all({verb::drop_truth, 0, number_}, {});
}

std::vector<double_double> remote_decimals::diagonal() {
  std::vector<double_double> all;
  (void)all_.command_all({verb::true_diagonal, 0, number_}, {.found_decimals = &all});
  return all;
}

std::vector<double_double> remote_decimals::times(std::span<const double_double> x) {
  std::vector<double_double> all;
  (void)all_.command_all({verb::true_times, 0, number_}, {.decimals = x, .found_decimals = &all});
  return all;
}

std::vector<double> remote_decimals::sums(std::span<const double> x) {
  std::vector<double> all;
  (void)all_.command_all({verb::true_sums, 0, number_}, {.doubles = x, .found = &all});
  return all;
}

int remote_decimals::widest_row() {
  return all_.command_all({verb::widest_row, 0, number_}, {});
}

std::unique_ptr<matrix::sparse_factor> remote_decimals::make_factor(std::span<const double> d) {
  return std::make_unique<remote_factor>(all_, all_.new_number(), verb::truth_to_factor, number_, d);
}

remote_stiffness::~remote_stiffness() {
  (void)all_.command_all({verb::drop_stiffness, 0, number_}, {});
}

std::unique_ptr<matrix::remote_matrix> remote_stiffness::copy() {
  const int number = all_.new_number();
  (void)all_.command_all({verb::copy, number, number_}, {});
  return std::make_unique<remote_stiffness>(all_, number, order_);
}

std::vector<double> remote_stiffness::diagonal() {
  std::vector<double> all;
  (void)all_.command_all({verb::diagonal, 0, number_}, {.found = &all});
  return all;
}

void remote_stiffness::scale(std::span<const double> d) {
  (void)all_.command_all({verb::scale, 0, number_}, {.doubles = d});
}

std::vector<matrix::matrix_entry> remote_stiffness::entries_in(std::span<const char> columns) {
  std::vector<matrix::matrix_entry> all;
  (void)all_.command_all({verb::entries_in, 0, number_}, {.marks = columns, .entries = &all});
  return all;
}

std::vector<long double> remote_stiffness::times(std::span<const long double> x) {
  std::vector<long double> all;
  (void)all_.command_all({verb::times, 0, number_}, {.longs = x, .found_longs = &all});
  return all;
}

std::vector<double> remote_stiffness::in_doubles(verb what, std::span<const double> x) {
  std::vector<double> all;
  (void)all_.command_all({what, 0, number_}, {.doubles = x, .found = &all});
  return all;
}

std::unique_ptr<matrix::sparse_factor> remote_stiffness::make_factor() {
  const std::vector<double> ones(static_cast<std::size_t>(order_), 1.0);
  return std::make_unique<remote_factor>(all_, all_.new_number(), verb::to_factor, number_, ones);
}

std::unique_ptr<matrix::remote_truth> remote_stiffness::truth() {
  const int number = all_.new_number();
  (void)all_.command_all({verb::make_truth, number, number_}, {});
  return std::make_unique<remote_decimals>(all_, number);
}

}  // namespace contct::distributed::petsc
