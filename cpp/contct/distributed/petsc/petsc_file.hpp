// Reading PETSc's binary of a matrix by parts: each rank its own rows.
#pragma once

#include "contct/distributed/petsc/file_parts.hpp"

namespace contct::distributed::petsc {

/// Collective: own rows. Throws input_error on every rank, with the words of read::parse_petsc_matrix.
[[nodiscard]] own_matrix read_own_binary(MPI_Comm job, const open_file& file, const matrix_file& what);

}  // namespace contct::distributed::petsc
