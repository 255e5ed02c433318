// The structure, the loads and the path of a problem.
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/model/structure.hpp"
#include "contct/path/path.hpp"

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

/// The loads of a problem's steps. Both arguments must outlive the result.
[[nodiscard]] inline load_history loads_of(const problem& p, const linear_structure& s) {
  const auto moved = [&p](int step, std::span<double> m) {
    add_moves(p.steps[step - 1], dofs_per_node(p.geometry), m);
  };
  const auto total = [&p, &s, moved](int step, std::span<double> f) {
    add_consistent_loads(p.geometry, p.steps[step - 1], f);
    add_settlements(s, p.steps[step - 1], f);
    if (p.steps[step - 1].moves.empty()) return;
    std::vector<double> m(f.size());
    moved(step, m);
    count_from_faces(s, m, f);
  };
  const auto work = [&p, truth = s.truth](int step) {
    return truth ? truth->work_of(p.steps[step - 1]) : rigid_work();
  };
  const bool any = std::ranges::any_of(p.steps, [](const load& l) { return !l.moves.empty(); });
  return {total, work, [&p](int step) { return p.steps[step - 1].from_zero; },
          any ? load_history::moves(moved) : nullptr};
}

/// The name of the engine for a path: the requested engine, or the fastest for "auto". The default is
/// "refactor" (one factorisation per increment) for the 1989 rule, and the fastest engine for other rules.
[[nodiscard]] inline std::string engine_for(const kernel_facts& leader, const std::string& asked,
                                            const linear_structure& s) {
  if (asked.empty() && leader.rule == contact_rule::listing) return "refactor";
  return asked.empty() || asked == "auto" ? std::string(quickest_engine(s)) : asked;
}

/// Follows a problem's path with a new engine named `engine`. `s` is the structure of the problem.
inline path_end follow(const problem& p, const linear_structure& s, std::string_view engine, kernel& leader,
                       const std::vector<observer*>& observers, const path_limits& limits = {}) {
  const std::unique_ptr<stiffness_engine> solves = make_engine(engine, s);
  return follow_path(s, static_cast<int>(p.steps.size()), loads_of(p, s), *solves, leader, observers, limits);
}

/// The force or moment on the structure by each support of `p` [supports], for displacements `u` [dofs], load
/// `l` and statuses `isep` [pairs]. The force of a pair on a fixed deflection is not part of a reaction.
[[nodiscard]] inline std::vector<double> reactions(const problem& p, const load& l, std::span<const double> u,
                                                   std::span<const int> isep) {
  std::vector<double> all = reactions(p.geometry, l, p.supports, u);
  const std::size_t stride = dofs_per_node(p.geometry);
  std::vector<int> held_by(nodes(p.geometry), -1);  // the first support that fixes a node's deflection
  for (int i = static_cast<int>(p.supports.size()) - 1; i >= 0; --i)
    if (p.supports[i].fixed && p.supports[i].dof == 0) held_by[p.supports[i].node] = i;
  const std::vector<contact_pair> pairs = pairs_under(p, l);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const contact_pair& at = pairs[i];
    const double force = at.surface * force_of(at, at.seen_in(u, stride), isep[i] == in_contact);
    if (held_by[at.node] >= 0 && force != 0.0) all[held_by[at.node]] += force;
  }
  return all;
}

}  // namespace contct
