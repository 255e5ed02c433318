// The dense problem that solvers of linear complementarity problems need.
#pragma once

#include <vector>

#include "bench/peers/exchange.hpp"
#include "contct/matrix/cholesky.hpp"

namespace bench::peers {

/// w = M z + q with w, z >= 0 and w'z = 0; M by columns.
struct complementarity {
  std::vector<double> m, q;
};

/// K as a band and its factor, and the compliance at the springs.
class compliance {
 public:
  /// `p` must outlive it. Throws std::runtime_error where K is not positive definite.
  explicit compliance(const contact_problem& p);

  /// A solve for every spring. M has 1 on its diagonal and q at most 1, so that a solver's absolute tolerance
  /// means the same for every problem: z of the problem is not the force.
  [[nodiscard]] complementarity complementarity_problem();

  /// The springs' forces that belong to a solution z.
  [[nodiscard]] std::vector<double> forces_of(const std::vector<double>& z) const;

  /// K^-1 (load - the springs' forces).
  [[nodiscard]] std::vector<double> displacement_under(const std::vector<double>& forces);

 private:
  const contact_problem& problem_;
  contct::matrix::stiffness_matrix stiffness_;
  contct::matrix::stiffness_factor factor_;
  std::vector<double> scale_;  // of each force [springs]
};

}  // namespace bench::peers
