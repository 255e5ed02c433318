// Which LAPACK is in use.
#pragma once

#include <string>

#include "contct/rooms.hpp"

namespace contct::matrix {

/// The LAPACK in use: its version as ILAVER has it, and the library that holds dpbtrf, as in
/// "LAPACK 3.11.0, liblapack.so.3.11.0"; and the configuration of OpenBLAS where that is loaded. Results of
/// solves differ between libraries, calls of CONTCT do not.
[[nodiscard]] std::string lapack_identity();

}  // namespace contct::matrix
