// The state of an exact path, and the equations that both rules solve there.
#pragma once

#include <vector>

#include "contct/exact/path.hpp"

namespace contct {

/// Step, share of the step, displacements and statuses.
class position {
 public:
  /// `p` must outlive this object.
  explicit position(const exact_problem& p);

  void begin_step(std::size_t number);  ///< from 0

  /// Factor K with the springs of the pairs in contact.
  void factor();
  [[nodiscard]] const lifted_solver& solver() const { return solver_; }

  /// R of the step at the dofs that are not fixed: the load's increment, and what settlements and moves of
  /// faces add to it.
  [[nodiscard]] const rational_vector& increment() const { return increment_; }
  /// u with (K + springs) u = b, for a `b` at the dofs that are not fixed, and the others moved to `settled`.
  [[nodiscard]] rational_vector moved(const rational_vector& b, const rational_vector& settled) const;
  /// The response to the step's whole load.
  [[nodiscard]] rational_vector response() const { return moved(increment_, settlement_); }
  /// The movement of fixed dofs in the step, minus that of the faces there.
  [[nodiscard]] const rational_vector& settlement() const { return settlement_; }
  /// The displacements at which the springs of the pairs in contact hold the structure under the load at the
  /// start of the step.
  [[nodiscard]] rational_vector at_start_of_step() const;

  [[nodiscard]] rational gap(std::size_t pair) const {
    const exact_pair& c = problem.pairs[pair];
    return c.surface * (c.face - c.seen_in(u));
  }
  /// n times what `v` does at a pair: positive towards its face.
  [[nodiscard]] rational approach(std::size_t pair, const rational_vector& v) const {
    const exact_pair& c = problem.pairs[pair];
    return c.surface * c.seen_in(v);
  }

  /// The events that lead from `before` to the statuses now, in order of pairs.
  [[nodiscard]] std::vector<event> events_since(const std::vector<char>& before) const;

  /// The end of a step at this position. `pairs_react`: a pair in contact at a fixed dof takes its part of
  /// the reaction.
  [[nodiscard]] exact_step_end end(path_status status, std::vector<exact_increment> increments,
                                   bool pairs_react) const;

  const exact_problem& problem;
  std::size_t step = 0;      ///< from 0
  rational fraction;         ///< of its load
  rational_vector u;         ///< displacements, counted from moving faces: see count_from_faces [dofs]
  std::vector<char> closed;  ///< [pairs]

 private:
  void unload();
  [[nodiscard]] rational_vector reactions(const rational_vector& displacement,
                                          const rational_vector& forces) const;
  /// The movement of the faces at a dof so far.
  [[nodiscard]] rational moved_face(std::size_t dof) const {
    return before_.moved[dof] + fraction * (problem.steps[step].moved[dof] - before_.moved[dof]);
  }
  /// The moves that become loads: settlements at fixed dofs, moves of faces at others. `from_faces`: what
  /// fixed dofs then do, counted from the faces.
  [[nodiscard]] rational_vector shift_of(rational_vector settled, const rational_vector& moved,
                                         bool from_faces) const;
  /// b less what K makes of dofs that are moved to `settled`.
  [[nodiscard]] rational_vector less_settled(rational_vector b, const rational_vector& settled) const;

  lifted_solver solver_;
  rational_vector increment_, settlement_;
  exact_step before_;  // what acted at the end of the step before
};

/// Increments that a step may take.
[[nodiscard]] inline std::size_t most_exact_increments(const exact_problem& p) {
  return 1000 + 50 * p.pairs.size();
}

}  // namespace contct
