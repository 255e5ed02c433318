// A small matrix in Matrix Market's format.
#pragma once

namespace contct {

/// A chain of three unit springs, the first of which is attached to the ground.
inline const char* const small_matrix =
    "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 1\n";

}  // namespace contct
