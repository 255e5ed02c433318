// Is the stiffness matrix of somebody else positive semidefinite? Proved, or shown not to be.
#pragma once

#include <optional>

#include "contct/exact/exact_problem.hpp"

namespace contct {

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

/// The dofs that free motions of K move are found modulo a prime, and the motions confirmed exactly. K is
/// semidefinite where it is definite on the others, which the bound on its least eigenvalue proves. Where its
/// factor fails, that shows a displacement, of which an exact sum decides. Throws std::runtime_error as
/// lifted_solver::factor does.
[[nodiscard]] definiteness definiteness_of(const problem& p, const exact_problem& exactly);

}  // namespace contct
