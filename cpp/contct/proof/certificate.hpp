// Certifies the final state of each step: proves bounds on the errors of the state's numbers from its
// residual (reference/certificate.md). If the state that the path reached is not certified, or the path
// failed, another state is tried: that of the exact path if the problem is small enough, otherwise the
// reference solution.
//
// The reference solution shares no code with kernels, engines or the loop over increments. Reference solution
// and path use the same assembled stiffness, Cholesky factor (linear/cholesky) and count of rigid-body
// motions (structure/rigid_modes).
#pragma once

#include <memory>
#include <optional>

#include "contct/path/solve_problem.hpp"
#include "contct/proof/allowed_errors.hpp"
#include "contct/proof/error_bounds.hpp"
#include "contct/proof/solved_path.hpp"

namespace contct {

class reference_path;  // contct/proof/reference_solution.hpp

class certifier {
 public:
  /// `p` and its structure `s` must outlive this object. `keeps_proofs`: certificates have the proofs of
  /// their bounds.
  certifier(const problem& p, const linear_structure& s, std::unique_ptr<exact_means> exactly = nullptr,
            bool keeps_proofs = false);
  ~certifier();

  /// Settles the end of a step whose path ended in `end` and `reached` a state, if it is not empty. Under the
  /// 1989 rule, this state is certified as it is. Under other rules it is refined; if it is not certified
  /// then, another state is tried. Sets what is known about the equilibrium in `end`. Empty if no state is
  /// known.
  [[nodiscard]] std::optional<solved_step> settle(path_end& end,
                                                  const std::optional<structure_state>& reached);

  /// The certificate of a state at the end of a step, as it is. Steps must come in order.
  [[nodiscard]] certificate certificate_of(const structure_state& s);

  /// Adds to the certificate of a state that is not certified what else is known about it.
  void complete(solved_step& s) const;

  /// Finds the equilibrium under the total load of every step without following the path (reference_path).
  /// Takes a few factorisations a step.
  ///
  /// The first step without a state decides the status: `mechanism` if its load certainly has no equilibrium,
  /// `path_ended` if that is not decided, `not_factored` if no solution is found.
  [[nodiscard]] solved_path find_final_states();

 private:
  [[nodiscard]] solved_step refined(structure_state s);
  [[nodiscard]] solved_step proved(structure_state s);
  [[nodiscard]] certificate judged(error_bounds b, const structure_state& s) const;
  [[nodiscard]] std::optional<solved_step> best_end(int step, const structure_state* reached, path_end& end);
  [[nodiscard]] solved_step chosen(solved_step s);
  [[nodiscard]] reference_path& reference();
  void find_pulling_pair(solved_step& s) const;

  const problem& problem_;
  const linear_structure& structure_;
  load_history loads_;
  std::unique_ptr<exact_means> exactly_;       // may be null
  std::unique_ptr<reference_path> reference_;  // null before the first use
  std::unique_ptr<error_prover> prover_;       // null if a proof takes too much memory or time
  allowed_errors allowed_;
};

}  // namespace contct
