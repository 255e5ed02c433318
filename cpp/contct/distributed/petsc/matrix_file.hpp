// Reading a matrix by parts: each rank a part of its file, from which each gets its rows.
#pragma once

#include <string>

#include "contct/distributed/petsc/own_matrix.hpp"

namespace contct::distributed::petsc {

/// Where a matrix stands.
struct matrix_file {
  std::string path, name;  ///< `name`: for messages
  int rows = 0;            ///< of a CalculiX stiffness, which does not say them; 0: a Matrix Market file
};

/// Collective: own rows. Throws text::input_error on every rank, with the words that one process would refuse
/// the file with.
[[nodiscard]] own_matrix read_own(MPI_Comm job, const matrix_file& what);

}  // namespace contct::distributed::petsc
