// Is the final state of a step right? Proved by bounds on the errors of its numbers, from its own residual
// (reference/certificate.md). What is wrong with one that is not proved right is told by the reference
// solution, which also judges structures that no problem file describes, and may be such a state itself: as
// a fallback, and in place of a path.
//
// The reference solution shares no code with kernels, engines or the loop. It does share the assembled
// stiffness, its Cholesky factor (matrix/cholesky) and the count of rigid motions
// (structure/rigid_modes) with them.
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

namespace contct::certify {

/// The tolerance of a certificate is this many eps / rcond, and never more than the next.
inline constexpr double certificate_factor = 1024.0;
inline constexpr double certificate_never_above = 1e-6;

/// What is known about the state that a step ended in. Lengths are relative to the largest
/// deflection that the path has seen, so that a state of no load has a measure too; and where slopes
/// count for more, relative to what these come to as deflections, so that a structure whose deflections
/// are rounding is not measured by rounding.
struct certificate {
  bool exact =
      false;  ///< proved within certified_share in every respect; without a proof, within `tolerance`
  // Of a certified state of a problem as proved, of others against the reference solution:
  double displacement_error = 0.0;  ///< of any deflection
  double shape_error = 0.0;  ///< of any number, against the size of its kind; or of any dof, scaled by the
                             ///< root of its stiffness, against the largest
  double equilibrium = 0.0;  ///< load left over by K D and the pairs' forces, scaled likewise
  double penetration = 0.0;  ///< of open pairs
  double tension = 0.0;      ///< how far the springs of closed pairs are stretched
  double rcond = 0.0;        ///< of the equilibrated stiffness
  double tolerance = 0.0;    ///< what all of these may reach
  /// False: the state is the reference solution's own, so that comparing the two shows nothing. What is left
  /// then is equilibrium, penetration and tension.
  bool independent = true;
  bool unique = true;        ///< false: other displacements are as good, so these have no bound
  bool unfounded = false;    ///< there is no equilibrium at all
  bool proof_tried = false;  ///< of a problem's states
  bool proved = false;       ///< there are bounds: the three that follow
  by_quantity error;         ///< on the errors of all numbers of a kind, absolute
  by_quantity allowed;       ///< what these may reach
  double worst_share = 0.0;  ///< the worst of them, as a share of the size of its kind
  std::string problem;       ///< what is wrong, in words; empty when exact
  int pulling = -1;          ///< of a state that is not exact: the pair in contact that pulls most, from 0
  double pull = 0.0;         ///< what it pulls with
};

/// Whole decimal digits that every number of a state has, as proved: 0 where nothing is. At most 15.
[[nodiscard]] int digits_of(const certificate& c);

/// Observes a path and certifies the end of every step that was solved.
class certifier final : public observer {
 public:
  /// `s` and what `total_load` refers to must outlive this object.
  certifier(const linear_structure& s, load_history total_load);

  /// Of a problem: every step is judged by proved bounds, where its stiffness is stored as a band; otherwise
  /// as above. `p` and `s` must outlive this object. The last two: see error_prover.
  certifier(const problem& p, const linear_structure& s, exact_residual exactly = nullptr,
            semidefinite_test exactly_semidefinite = nullptr);

  void step_ended(const step_state& s) override;

  /// What betters the ends of steps before they are told, of a problem's path. This object must outlive it.
  [[nodiscard]] state_refiner refiner();
  /// The reference solution as the end of a step that a path cannot reach, found with `search` where that
  /// alone gives up. Valid as long as this object.
  [[nodiscard]] fallback_solver fallback();
  /// Look for the equilibrium at a share of `step` from a state near it; see error_prover::search.
  [[nodiscard]] bool search(int step, double share, std::span<double> displacement, std::span<int> isep);

  /// Keep what proves the bounds of each step that follows.
  void keep_proofs();
  /// In the order of steps(); none where nothing is proved, or none are kept.
  [[nodiscard]] const std::vector<std::optional<step_proof>>& proofs() const { return proofs_; }

  /// One for each step ended so far; none for a step that did not reach its load.
  [[nodiscard]] const std::vector<std::optional<certificate>>& steps() const { return steps_; }
  [[nodiscard]] bool all_exact() const;

 private:
  [[nodiscard]] certificate judge(const step_state& s);
  void prove(const step_state& s, certificate& c);
  void take(const error_bounds& b, const step_state& s, certificate& c);
  [[nodiscard]] std::string status_words(std::size_t pair, const step_state& s) const;
  void compare(const step_state& s, std::span<const double> load, certificate& c);
  void measure_state(const step_state& s, std::span<const double> load, certificate& c) const;
  void find_pulling_pair(const step_state& s, certificate& c) const;
  void compare_with(const reference_answer& a, const step_state& s, certificate& c) const;
  void remember_sizes(std::span<const double> displacement);
  [[nodiscard]] double largest_length() const;
  [[nodiscard]] bool deflects(std::size_t dof) const { return structure_.deflects(static_cast<int>(dof)); }

  const linear_structure& structure_;
  load_history total_load_;
  std::optional<reference_solver> reference_;  // made when it is first asked
  const problem* problem_ = nullptr;
  std::unique_ptr<error_prover> prover_;
  allowed_errors allowed_;
  std::vector<double> scale_;          // roots of the stiffness at each dof [dofs]
  double largest_scale_ = 0.0;         // of a deflection that is not fixed
  double largest_deflection_ = 0.0;    // of path and oracle, so far
  double largest_displacement_ = 0.0;  // scaled, any dof
  std::vector<std::optional<certificate>> steps_;
  std::vector<std::optional<step_proof>> proofs_;
};

/// A fallback for `s`, which must outlive it: the reference solution as the end of a step that a path cannot
/// reach. Of `total_load` only the work counts, which decides what is driven.
[[nodiscard]] fallback_solver fallback_to_reference(const linear_structure& s, load_history total_load = {});

/// Only the ends: find the equilibrium under the total load of every step and tell it to the observers as
/// that step's end.
/// An elastic structure on one-sided springs without friction has no memory: each is where the path would
/// arrive. A handful of factorisations a step; no increments, no events.
///
/// Ends as `mechanism` at the first step whose load certainly nothing carries, as `path_ended` where that is
/// not decided, and as `not_factored` where no answer is found in double precision, nor by `helper` and
/// `exactly`; that step is not told.
path_end find_final_states(const linear_structure& s, int steps, const load_history& total_load,
                           std::span<observer* const> observers, certifier* helper = nullptr,
                           const exact_follower& exactly = nullptr);

}  // namespace contct::certify
