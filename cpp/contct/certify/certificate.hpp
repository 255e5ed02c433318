// Is the final state of a step right? Proved by bounds on the errors of its numbers, from its own residual
// (reference/certificate.md). Where a path's end is not proved, or the path was lost, another one is found:
// the exact path's where the problem is small enough for it, otherwise the reference solution, which also
// tells what is wrong with a state that nothing proves.
//
// The reference solution shares no code with kernels, engines or the loop. It does share the assembled
// stiffness, its Cholesky factor (matrix/cholesky) and the count of rigid-body motions
// (model/rigid_modes) with them.
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

/// The certificate of a step's final state. Lengths are relative to the largest deflection that the path has
/// seen, so that a state of no load has a measure too; and where slopes count for more, relative to what
/// these come to as deflections, so that a structure whose deflections are rounding is not measured by
/// rounding.
struct certificate {
  bool certified = false;  ///< proved within certified_share in every respect
  // Proved errors of a certified state; for others, differences from the reference solution:
  double displacement_error = 0.0;  ///< of any deflection
  double shape_error = 0.0;  ///< of any number, against the size of its kind; or of any dof, scaled by the
                             ///< root of its stiffness, against the largest
  double equilibrium = 0.0;  ///< residual load of K D and the pairs' forces, scaled likewise
  double penetration = 0.0;  ///< of separated pairs
  double tension = 0.0;      ///< how far the springs of pairs in contact are stretched
  double rcond = 0.0;        ///< of the equilibrated stiffness
  /// False: the state is the reference solution itself, so that a comparison shows nothing. Then only
  /// equilibrium, penetration and tension are checked.
  bool independent = true;
  bool unique = true;        ///< false: other displacements are as good, so these have no bound
  bool proved = false;       ///< there are bounds: the three that follow
  by_quantity error;         ///< on the errors of all numbers of a kind, absolute
  by_quantity allowed;       ///< what these may reach
  double worst_share = 0.0;  ///< the worst of them, as a share of the size of its kind
  std::shared_ptr<const step_proof> proof;  ///< what proves the bounds, if that is kept
  std::string problem;                      ///< the error, in words; empty when certified
  int pulling = -1;   ///< of a state that is not certified: the pair in contact that pulls most, from 0
  double pull = 0.0;  ///< its tensile force
};

/// Whole decimal digits that every number of a state has, as proved: 0 where nothing is. At most 15.
[[nodiscard]] int digits_of(const certificate& c);

/// Observes a path and certifies the end of every step that was solved.
class certifier final : public observer {
 public:
  /// `p` and `s`, its structure, must outlive this object.
  certifier(const problem& p, const linear_structure& s, std::unique_ptr<exact_means> exactly = nullptr);

  void step_ended(const step_state& s) override;

  /// Proves or replaces the final state of each step of a path. This object must outlive the result.
  [[nodiscard]] end_finder ends();

  /// Only the ends: find the equilibrium under the total load of every step and tell it to the observers as
  /// that step's end. An elastic structure on one-sided springs without friction has no memory: each is where
  /// the path would arrive. A handful of factorisations a step; no increments, no events.
  ///
  /// Ends as `mechanism` at the first step whose load certainly nothing carries, as `path_ended` where that
  /// is not decided, and as `not_factored` where no answer is found; that step is not told.
  path_end find_final_states(std::span<observer* const> observers);

  /// Keep what proves the bounds of each step that follows.
  void keep_proofs();

  /// One for each step ended so far; none for a step that did not reach its load.
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
  /// Displacements at the end of a step, counted from the faces that it moves.
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

  /// The proof of a state before the path reports it.
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
  std::optional<reference_solver> reference_;  // made when it is first asked
  std::unique_ptr<error_prover> prover_;       // null where a proof takes too much memory
  allowed_errors allowed_;
  std::optional<proved_state> last_;
  std::vector<double> scale_;          // roots of the stiffness at each dof [dofs]
  double largest_scale_ = 0.0;         // of a deflection that is not fixed
  double largest_deflection_ = 0.0;    // of path and reference solution, so far
  double largest_displacement_ = 0.0;  // scaled, any dof
  std::vector<std::optional<certificate>> steps_;
};

}  // namespace contct
