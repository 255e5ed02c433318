// The present state of an exact path, under the corrected or the 1989 rule, and the solution of the equations
// of equilibrium in this state.
#pragma once

#include <vector>

#include "contct/exact/path.hpp"

namespace contct {

class position {
 public:
  /// `p` must outlive this object.
  explicit position(const exact_problem& p);

  void begin_step(std::size_t number);  ///< from 0

  /// Factors K with the springs of the pairs in contact.
  void factor();
  [[nodiscard]] const lifted_solver& solver() const { return solver_; }

  /// R, the load increment of the step at free dofs, including the loads caused by settlements and moved
  /// faces.
  [[nodiscard]] const rational_vector& increment() const { return increment_; }
  /// Solves (K + springs) u = b at free dofs, and sets u to `settled` at fixed dofs. `b` includes the forces
  /// that `settled` causes at free dofs.
  [[nodiscard]] rational_vector moved(const rational_vector& b, const rational_vector& settled) const;
  /// The response to the whole load increment of the step.
  [[nodiscard]] rational_vector response() const { return moved(increment_, settlement_); }
  /// The movement of fixed dofs in the step less the movement of the faces there; 0 at free dofs.
  [[nodiscard]] const rational_vector& settlement() const { return settlement_; }
  /// The equilibrium with the springs of pairs in contact, under the load at the start of the step.
  [[nodiscard]] rational_vector at_start_of_step() const;

  [[nodiscard]] rational gap(std::size_t pair) const {
    const exact_pair& c = problem.pairs[pair];
    return gap_of(c, c.seen_in(u), false);
  }
  /// The displacement of a pair in `v` towards its face.
  [[nodiscard]] rational approach(std::size_t pair, const rational_vector& v) const {
    const exact_pair& c = problem.pairs[pair];
    return c.surface * c.seen_in(v);
  }

  /// The events that lead from the statuses `before` to the present ones, in order of pairs.
  [[nodiscard]] std::vector<event> events_since(const std::vector<int>& before) const;

  /// The result of a step that ends in this state. `pairs_react`: pairs at fixed dofs carry a part of the
  /// reaction.
  [[nodiscard]] exact_step_end end(path_status status, std::vector<exact_increment> increments,
                                   bool pairs_react) const;

  const exact_problem& problem;
  std::size_t step = 0;   ///< from 0
  rational fraction;      ///< share of the step's load applied so far
  rational_vector u;      ///< displacements less the moves of faces: see equations::from_faces [dofs]
  std::vector<int> isep;  ///< the status of each pair [pairs]

 private:
  void unload();
  /// The movement of the face at a dof up to this position.
  [[nodiscard]] rational moved_face(std::size_t dof) const {
    return before_.moved[dof] + fraction * (problem.steps[step].moved[dof] - before_.moved[dof]);
  }
  lifted_solver solver_;
  rational_vector increment_, settlement_;
  exact_step before_;  // the loads at the end of the previous step
};

/// A path of one rule, step by step.
class exact_rule {
 public:
  /// `pairs_react`: see position::end. Both references must outlive this object.
  exact_rule(const exact_problem& p, const exact_progress& tell, bool pairs_react)
      : at_(p), tell_(tell), pairs_react_(pairs_react) {}
  virtual ~exact_rule() = default;
  exact_rule(const exact_rule&) = delete;
  exact_rule& operator=(const exact_rule&) = delete;

  [[nodiscard]] exact_path follow();

 protected:
  /// Follows a step to its end, and adds its increments to increments_.
  virtual path_status follow_step() = 0;
  /// Tells that the next increment begins; false beyond the limit of increments for a step.
  [[nodiscard]] bool begin_increment(std::size_t number) const;

  position at_;
  std::vector<exact_increment> increments_;
  std::optional<mechanism_proof> mechanism_;  // of the first mechanism

 private:
  const exact_progress& tell_;
  bool pairs_react_;
};

}  // namespace contct
