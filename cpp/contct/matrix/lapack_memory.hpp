// The memory that a LAPACK takes for itself.
#pragma once

#include "contct/rooms.hpp"

namespace contct::matrix {

/// Each thread of OpenBLAS takes a buffer of 128 MiB for its first work, and where there is no room for it
/// asks again for ever. After this the calling thread has its own, or every thread, as it must be where no
/// more memory can be had later. Throws std::bad_alloc where there is no room. Other LAPACKs take nothing.
void take_lapack_memory(bool of_every_thread);

}  // namespace contct::matrix
