// Certifies the final state of each step: proves bounds on the errors of the state's numbers from its
// residual (reference/certificate.md). If the state that the path reached is not certified, or the path
// failed, another state is tried: that of the exact path if the problem is small enough, otherwise the
// reference solution. If no state is certified by a proof, a comparison with the reference solution shows the
// error.
//
// The reference solution shares no code with kernels, engines or the loop over increments. Reference solution
// and path use the same assembled stiffness, Cholesky factor (matrix/cholesky) and count of rigid-body
// motions (model/rigid_modes).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/certify/allowed_errors.hpp"
#include "contct/certify/error_bounds.hpp"
#include "contct/certify/reference_solution.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"

namespace contct {

/// The certificate of a step's final state. displacement_error, penetration and tension are relative to the
/// largest deflection on the path so far, or to the largest slope converted to a deflection by sqrt(K_ii),
/// whichever is larger, because all deflections may be rounding. equilibrium is relative to the largest
/// displacement on the path so far, times sqrt(K_ii).
struct certificate {
  /// Every error is at most certified_share: by a proof or, without one, by comparison with the reference.
  bool certified = false;
  // The next two: proved errors if a proof certified the state. Otherwise differences from the reference
  // solution; for shape_error, of displacements times sqrt(K_ii), relative to the largest on the path so far.
  double displacement_error = 0.0;  ///< largest error of a deflection
  double shape_error = 0.0;         ///< largest error of a number, relative to the size of its kind
  double equilibrium = 0.0;         ///< largest residual of a dof, divided by sqrt(K_ii)
  double penetration = 0.0;         ///< largest depth of a separated pair beyond its face
  double tension = 0.0;  ///< largest distance of a pair in contact from its face, if its spring pulls
  double rcond = 0.0;    ///< reciprocal condition number of the equilibrated stiffness
  /// False if the state is the reference solution, so that a comparison with that solution shows no error.
  bool independent = true;
  /// False if other displacements balance the load too: displacements then have no error bound.
  bool unique = true;
  bool proved = false;             ///< the bounds are proved: `error`, `allowed` and `worst_share` are set
  by_quantity error;               ///< bounds on the errors of each kind of number, absolute
  std::optional<double> pressure;  ///< a bound on the errors of bearing pressures; empty without beds
  by_quantity allowed;             ///< the errors that a certified state may have, absolute
  double worst_share = 0.0;        ///< the largest error relative to the size of its kind
  std::shared_ptr<const step_proof> proof;  ///< the data that prove the bounds; null unless proofs are kept
  std::string problem;                      ///< what is wrong, in words; empty if certified
  std::string rule;                         ///< what is allowed instead; empty: errors up to certified_share
  int pulling = -1;   ///< not certified: the pair in contact that pulls most, from 0; -1: none
  double pull = 0.0;  ///< the tensile force of that pair
};

/// The number of decimal digits that are proved for every number of a state, relative to the size of the
/// number's kind: 0 (nothing is proved) to 15.
[[nodiscard]] int digits_of(const certificate& c);

/// Observes a path and certifies the end of every step that is solved.
class certifier final : public observer {
 public:
  /// `p` and its structure `s` must outlive this object.
  certifier(const problem& p, const linear_structure& s, std::unique_ptr<exact_means> exactly = nullptr);

  void step_ended(const step_state& s) override;

  /// Returns a function that proves or replaces the final state of a step. This object must outlive the
  /// function.
  [[nodiscard]] end_finder ends();

  /// Finds the equilibrium under the total load of every step without following the path, and reports it to
  /// the observers as the end of that step. A path would arrive at the same states, because an elastic
  /// structure on one-sided springs without friction has no memory. Takes a few factorisations a step and has
  /// no increments or events.
  ///
  /// A step without a state is not reported to the observers. The first of these steps decides the status:
  /// `mechanism` if its load certainly has no equilibrium, `path_ended` if that is not decided,
  /// `not_factored` if no solution is found.
  path_end find_final_states(std::span<observer* const> observers);

  /// Keeps the proofs of the bounds in later certificates.
  void keep_proofs();

  /// The certificate of each step that ended; empty for a step that did not reach its full load.
  [[nodiscard]] const std::vector<std::optional<certificate>>& steps() const { return steps_; }
  [[nodiscard]] bool all_certified() const;

 private:
  [[nodiscard]] found_end end_of(int step, const full_load_state* reached);
  [[nodiscard]] bool is_certified(int step, full_load_state& s);
  [[nodiscard]] certificate judge(const step_state& s);
  [[nodiscard]] certificate proof_of(const step_state& s);
  void take(const error_bounds& b, const step_state& s, certificate& c);
  [[nodiscard]] std::string status_words(std::size_t pair, const step_state& s) const;
  [[nodiscard]] std::vector<double> load_at(int step) const;
  /// Displacements [dofs] less the distances by which the faces are moved at the end of a step.
  [[nodiscard]] std::vector<double> from_faces(int step, std::span<const double> displacement) const;
  [[nodiscard]] reference_answer reference_at(int step);
  void compare(const step_state& s, std::span<const double> load, certificate& c);
  void measure_state(const step_state& s, std::span<const double> load, certificate& c) const;
  void find_pulling_pair(const step_state& s, certificate& c) const;
  [[nodiscard]] std::string worst_of(const certificate& c) const;
  void compare_with(const reference_answer& a, const step_state& s, certificate& c) const;
  void remember_sizes(std::span<const double> displacement);
  [[nodiscard]] double largest_length() const;
  [[nodiscard]] bool deflects(std::size_t dof) const { return structure_.deflects(static_cast<int>(dof)); }

  /// The certificate of a state that is not yet reported.
  struct proved_state {
    int step;
    std::vector<double> displacement;
    certificate what;
    allowed_errors allowed;
  };

  const problem& problem_;
  const linear_structure& structure_;
  load_history total_load_;
  std::unique_ptr<exact_means> exactly_;       // may be null
  std::optional<reference_solver> reference_;  // made at the first use
  std::unique_ptr<error_prover> prover_;       // null if a proof takes too much memory or time
  allowed_errors allowed_;
  std::optional<proved_state> last_;
  std::vector<double> scale_;   // sqrt(K_ii) [dofs]
  double largest_scale_ = 0.0;  // the largest scale_ of a free deflection
  double largest_deflection_ = 0.0;
  double largest_displacement_ = 0.0;  // the largest product of displacement and scale_ so far
  std::vector<std::optional<certificate>> steps_;
};

}  // namespace contct
