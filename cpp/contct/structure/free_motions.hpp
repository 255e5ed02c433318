// The motions that a stiffness matrix leaves free, found from the matrix alone.
#pragma once

#include <optional>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/structure/rigid_modes.hpp"

namespace contct::structure {

/// With its diagonal scaled to 1, which removes the units, a stiffness matrix has eigenvalues between 0 and
/// a few. One up to this size counts as 0, and its motion as free: matrices in files have 14 digits or
/// more, and a beam of 1000 elements bends with 5e-13 as a cantilever, with 2e-11 where it is free.
inline constexpr double free_below = 1e-13;
/// A matrix with one below minus this is refused as not positive semidefinite.
inline constexpr double negative_beyond = 1e-10;

struct free_motions {
  int count = 0;
  std::vector<rigid_row> rows;  ///< [rows of the matrix] what each motion does there
  double rounding = 0.0;        ///< how far off these may be, relative
  double stiffest_free = 0.0;   ///< the largest eigenvalue that counts as 0, in magnitude
  double softest_held = 1.0;    ///< the smallest that is not; 1 where it was not needed
};

/// Find them in `k`, whose diagonal is positive. `known`: how many there are, where that is known; they must
/// then be free to 1e-10. Takes a factorisation, and up to three times that and some forty solves where the
/// matrix is close to leaving something free; memory for K once more and a factor.
///
/// Throws std::invalid_argument when k has a negative eigenvalue, leaves more than six motions free, or
/// fewer than `known`; the message calls it "the matrix".
[[nodiscard]] free_motions find_free_motions(const stiffness_matrix& k, std::optional<int> known);

}  // namespace contct::structure
