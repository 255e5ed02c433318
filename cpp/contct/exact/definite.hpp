// Is a stiffness matrix positive semidefinite? Decided without rounding.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "contct/exact/lifted_solver.hpp"

namespace contct::exact {

/// A displacement on which the matrix does negative work: no structure has such a matrix.
struct negative_work {
  vector motion;  ///< [dofs], 0 at fixed ones
  rational work;  ///< motion' K motion
};

/// Nothing where K is positive semidefinite on the dofs that are not fixed, with a proof; otherwise a
/// displacement that shows that it is not. `place` as lifted_solver has it.
///
/// Both are proved by exact sums, whatever the numbers in between were rounded to. With K scaled to ones on
/// its diagonal, up to a factor of 8, and any lower triangle L that has L L' near K - c, K is definite if the
/// rows of K - c - L L' add up to less than c. L comes from Cholesky's method with so many bits behind the
/// point; where that fails, it shows where negative work may be found. If it is not there, the bits are
/// doubled: K is regular on the dofs with pivots, so they suffice some time.
///
/// Throws std::runtime_error as lifted_solver::factor does, where more than 16,384 bits would be needed, and
/// where L would take more than `most_bytes`.
[[nodiscard]] std::optional<negative_work> find_negative_work(const sparse_rows& k,
                                                              std::span<const char> fixed,
                                                              std::span<const int> place,
                                                              std::int64_t most_bytes);

}  // namespace contct::exact
