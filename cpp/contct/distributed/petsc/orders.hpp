// What rank 0 sends before everything that all ranks do together.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "contct/distributed/petsc/shared_matrix.hpp"
#include "contct/matrix/block_solve.hpp"
#include "contct/numeric/double_double.hpp"

namespace contct::distributed::petsc {

using numeric::double_double;

enum class verb : int {
  // of matrices that are factored
  make,
  factor,
  solve,
  solve_units,
  watch,
  drop,
  // of stiffnesses
  assemble,
  read,
  copy,
  scale,
  diagonal,
  entries_in,
  times,
  magnitudes,
  half_units,
  sums,
  to_factor,
  drop_stiffness,
  // of these in 32 digits
  make_truth,
  true_diagonal,
  true_times,
  true_sums,
  widest_row,
  truth_to_factor,
  drop_truth,
  // of the job
  measure,
  leave
};

/// What rank 0 wants of all ranks.
struct command {
  verb what;
  int matrix = 0;  // which
  int from = 0;    // the one that it is made of
  int count = 0;   // its order; rows to be watched
  std::array<int, matrix::block_width> units = {};
};

/// What rank 0 gives with a command, or takes; null on other ranks.
struct given {
  const matrix::sparse_columns* matrix = nullptr;
  double* vector = nullptr;                  // a diagonal, or a right-hand side that becomes the solution
  const std::vector<int>* rows = nullptr;    // to be watched
  std::vector<double>* solutions = nullptr;  // at these
  long* peaks = nullptr;                     // [ranks]
  // What is sent to every rank, and the parts that come back.
  std::span<const char> marks = {};
  std::span<const double> doubles = {};
  std::span<const long double> longs = {};
  std::span<const double_double> decimals = {};
  std::vector<matrix::matrix_entry>* entries = nullptr;
  std::vector<double>* found = nullptr;
  std::vector<long double>* found_longs = nullptr;
  std::vector<double_double>* found_decimals = nullptr;
  std::string* refused = nullptr;  // why a stiffness was not made
};

/// Rank 0, which has all ranks obey.
class commander {
 public:
  commander() = default;
  virtual ~commander() = default;
  commander(const commander&) = delete;
  commander& operator=(const commander&) = delete;

  /// What comes of it on every rank. `g` is what rank 0 gives or takes.
  virtual int command_all(command c, const given& g) = 0;
  [[nodiscard]] virtual shared_matrix& at(int number) = 0;
  [[nodiscard]] virtual int new_number() = 0;
};

}  // namespace contct::distributed::petsc
