// Decisions in rational numbers for a path in doubles, and whether an external stiffness matrix is positive
// semidefinite.
#pragma once

#include <memory>
#include <optional>

#include "contct/certify/certificate.hpp"
#include "contct/exact/path.hpp"

namespace contct {

/// Limits on structures, bandwidths and lengths of numbers for the use of rational numbers on a path in
/// doubles: beyond these it takes too long for a run in which exact numbers were not requested.
inline constexpr int most_dofs_beside_doubles = 1000;
inline constexpr int most_subdiagonals_beside_doubles = 64;
inline constexpr std::size_t most_bits_beside_doubles = std::size_t{1} << 14U;

/// A displacement on which the matrix does negative work: no structure has such a matrix.
struct negative_work {
  rational_vector motion;  ///< [dofs], 0 at fixed ones
  rational work;           ///< motion' K motion
};

/// At most one of the two; neither where 32 digits do not decide it.
struct definiteness {
  bool semidefinite = false;  ///< on the dofs that are not fixed, for certain
  std::optional<negative_work> shown = {};
};

/// The dofs that rigid-body motions of K move are found modulo a prime, and the motions confirmed exactly. K
/// is semidefinite if it is definite on the others, which the bound on its least eigenvalue proves. If the
/// factorisation fails, it gives a displacement whose work is decided by an exact sum. Throws
/// std::runtime_error as lifted_solver::factor does.
[[nodiscard]] definiteness definiteness_of(const problem& p, const exact_problem& exactly);

/// For a path in doubles; a problem that is too large gets no decision. `p` must outlive what is returned.
[[nodiscard]] std::unique_ptr<exact_means> exact_means_of(const problem& p);

}  // namespace contct
