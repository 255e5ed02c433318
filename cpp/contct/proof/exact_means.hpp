// Exact states and residuals for the certificates of paths in doubles, and the test whether the matrix of a
// file is positive semidefinite.
#pragma once

#include <memory>
#include <optional>

#include "contct/exact/path.hpp"
#include "contct/proof/certificate.hpp"

namespace contct {

/// The largest problems and numbers for which the certificate of a path in doubles uses rational numbers.
/// Beyond these limits, rational numbers would take too long.
inline constexpr int most_dofs_beside_doubles = 1000;
inline constexpr int most_subdiagonals_beside_doubles = 64;
inline constexpr std::size_t most_bits_beside_doubles = std::size_t{1} << 14U;

/// Displacements on which K does negative work. The stiffness matrix of a structure never does negative work.
struct negative_work {
  rational_vector motion;  ///< 0 at fixed dofs [dofs]
  rational work;           ///< motion' K motion
};

/// The answer to whether K is semidefinite; neither member is set if 32 digits do not decide.
struct definiteness {
  bool semidefinite = false;                ///< proved on the dofs that are not fixed
  std::optional<negative_work> shown = {};  ///< the proof that K is not semidefinite
};

/// Decides whether K is semidefinite. Finds one dof for each rigid-body motion of K modulo a prime, and
/// confirms the motions exactly. K is semidefinite if it is definite on the other dofs, which a bound on its
/// least eigenvalue proves. If the factorisation for this bound fails, it gives displacements on which K may
/// do negative work, and this work is computed exactly. Throws the std::runtime_error of
/// lifted_solver::factor.
[[nodiscard]] definiteness definiteness_of(const problem& p, const exact_problem& exactly);

/// Exact answers for the certificate of a path in doubles; empty or false beyond the limits above. `p` must
/// outlive the result.
[[nodiscard]] std::unique_ptr<exact_means> exact_means_of(const problem& p);

}  // namespace contct
