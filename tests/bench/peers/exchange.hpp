// What the benchmark and the programs beside it hand each other: files in a folder.
//     stiffness.mtx   K of the dofs that no support fixes, lower triangle, in the order of a narrow band
//     problem.txt     the load on them, and the contact pairs
//     answer.txt      what a program found, and what it took
#pragma once

#include <string>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"

namespace bench::peers {

/// A one-sided spring at a row of K, from 0: it presses with stiffness * side * (u - face) where that is
/// positive.
struct one_sided_spring {
  int row;
  int side;  ///< +1: the face is above
  double face, stiffness;
};

/// Find u with K u + the springs' forces = load.
struct contact_problem {
  contct::matrix::sparse_columns stiffness;
  std::vector<double> load;  ///< [rows]
  std::vector<one_sided_spring> springs;

  [[nodiscard]] int rows() const { return stiffness.order(); }
};

void write_problem(const std::string& folder, const contact_problem& p);
[[nodiscard]] contact_problem read_problem(const std::string& folder);

/// What a program found.
struct answer {
  bool found = false;
  double seconds = 0.0;        ///< of processor time, from K in memory to u
  double build_seconds = 0.0;  ///< before these: of the dense matrix that an LCP needs
  int steps = 0;               ///< pivots, iterations or events, as the method counts
  long peak_kib = 0;           ///< the most memory that the process had
  std::vector<double> u;       ///< [rows]; not a number where the program does not tell
  std::vector<double> forces;  ///< [springs] positive where it presses
};

void write_answer(const std::string& folder, const answer& a);
[[nodiscard]] answer read_answer(const std::string& folder);

/// What the springs press with under `u`; 0 where they do not.
[[nodiscard]] std::vector<double> forces_under(const contact_problem& p, const std::vector<double>& u);

/// Processor time of this process so far, all threads.
[[nodiscard]] double process_seconds();

/// The most memory that this process has had.
[[nodiscard]] long own_peak_kib();

/// The main function of a program PROGRAM METHOD FOLDER ROUNDS: solves as often as it is asked to, and writes
/// the answer of median time. Returns the exit status.
int solve_as_asked(int argc, char** argv,
                   answer (*solve)(const std::string& method, const std::string& folder));

}  // namespace bench::peers
