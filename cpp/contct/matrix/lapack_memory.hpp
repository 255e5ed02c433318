// The memory that a LAPACK takes for itself.
#pragma once

#include "contct/rooms.hpp"

namespace contct::matrix {

/// Each thread of OpenBLAS takes a buffer of 128 MiB for its first work, and where there is no room for it
/// asks again for ever. After this it has them. Throws std::bad_alloc where there is no room. Other LAPACKs
/// take nothing.
void take_lapack_memory();

}  // namespace contct::matrix
