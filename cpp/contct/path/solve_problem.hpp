// The structure and the loads of a problem.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/linear/engine.hpp"
#include "contct/structure/problem.hpp"
#include "contct/structure/statics.hpp"

namespace contct {

/// The structure of a problem. Supports that a step moves are marked as settling.
[[nodiscard]] inline linear_structure structure_of(const problem& p) {
  std::vector<support> supports = p.supports;
  std::set<std::pair<int, int>> settling;
  for (const load& l : p.steps)
    for (const prescribed_displacement& g : l.settlements) settling.emplace(g.node, g.dof);
  for (const load& l : p.steps)  // relative to a moving face, a fixed dof moves too
    for (const face_move& m : l.moves) settling.emplace(m.node, m.dof);
  for (support& s : supports) s.settles = s.fixed && settling.contains({s.node, s.dof});
  return build(p.geometry, supports, p.pairs);
}

/// The loads and face movements at the ends of a problem's steps, from 1.
class load_history {
 public:
  /// Both arguments must outlive this object.
  load_history(const problem& p, const linear_structure& s) : problem_(p), structure_(s) {}

  /// The total load [dofs], as right_hand_side has it.
  [[nodiscard]] std::vector<double> total(int step) const {
    return right_hand_side(structure_, nodal_loads(problem_.geometry, at(step)));
  }
  /// The movement of faces [dofs]; empty if no step moves a face, or in step 0.
  [[nodiscard]] std::vector<double> moved(int step) const {
    if (step == 0 || std::ranges::all_of(problem_.steps, [](const load& l) { return l.moves.empty(); }))
      return {};
    return sums_at_dofs<double>(at(step).moves, structure_.dofs(), structure_.dofs_per_node);
  }
  /// The movement of faces at the beginning of a step [dofs]; empty as in `moved`.
  [[nodiscard]] std::vector<double> moved_before(int step) const {
    return moved(from_zero(step) ? 0 : step - 1);
  }
  /// The work of the total load on the rigid-body motions, without rounding; unknown for a matrix or in step
  /// 0.
  [[nodiscard]] rigid_work work(int step) const {
    return structure_.truth && step > 0 ? structure_.truth->work_of(at(step)) : rigid_work();
  }
  /// True if a step starts from the unloaded structure.
  [[nodiscard]] bool from_zero(int step) const { return step == 1 || at(step).from_zero; }

 private:
  [[nodiscard]] const load& at(int step) const { return problem_.steps[step - 1]; }

  const problem& problem_;
  const linear_structure& structure_;
};

/// The name of the engine for a path: the requested engine, or the fastest for "auto". The default is
/// "refactor" (one factorisation per increment) for the 1989 rule, and the fastest engine for other rules.
[[nodiscard]] inline std::string engine_for(const kernel_facts& leader, const std::string& asked,
                                            const linear_structure& s) {
  if (asked.empty() && leader.rule == contact_rule::listing) return "refactor";
  return asked.empty() || asked == "auto" ? std::string(quickest_engine(s)) : asked;
}

}  // namespace contct
