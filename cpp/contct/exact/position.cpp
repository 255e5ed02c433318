#include "contct/exact/position.hpp"

#include <set>
#include <utility>

namespace contct {

position::position(const exact_problem& p)
    : problem(p), u(p.dofs()), solver_(p.stiffness, p.fixed, p.place, p.longest) {}

void position::begin_step(std::size_t number) {
  step = number;
  if (number == 0 || problem.steps[number].from_zero)
    unload();
  else
    before_ = problem.steps[number - 1];
  fraction = 0;
  const exact_step& after = problem.steps[number];
  increment_ = after.force;
  settlement_ = after.settlement;
  rational_vector moved = after.moved;
  for (std::size_t dof = 0; dof < u.size(); ++dof) {
    increment_[dof] -= before_.force[dof];
    settlement_[dof] -= before_.settlement[dof];
    moved[dof] -= before_.moved[dof];
  }
  increment_ = less_settled(std::move(increment_), shift_of(settlement_, moved, false));
  settlement_ = shift_of(std::move(settlement_), moved, true);
}

rational_vector position::shift_of(rational_vector settled, const rational_vector& moved,
                                   bool from_faces) const {
  for (std::size_t dof = 0; dof < settled.size(); ++dof) {
    if (problem.fixed[dof] == 0) settled[dof] = from_faces ? rational(0) : moved[dof];
    if (problem.fixed[dof] != 0 && from_faces) settled[dof] -= moved[dof];
  }
  return settled;
}

void position::unload() {
  u.assign(problem.dofs(), rational());
  before_ = {u, {}, u, u};
  closed.clear();
  for (const exact_pair& c : problem.pairs) closed.push_back(c.closed ? 1 : 0);
}

rational_vector position::less_settled(rational_vector b, const rational_vector& settled) const {
  for (std::size_t dof = 0; dof < b.size(); ++dof) {
    if (problem.fixed[dof] != 0) b[dof] = 0;
    if (settled[dof] == 0) continue;
    for (const auto& [row, k] : problem.stiffness[dof])
      if (problem.fixed[row] == 0) b[row] -= k * settled[dof];
  }
  return b;
}

void position::factor() {
  std::vector<added_spring> springs;
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (closed[i] != 0)
      springs.push_back({problem.pairs[i].dof, problem.pairs[i].stiffness, problem.pairs[i].other});
  solver_.factor(springs);
}

rational_vector position::moved(const rational_vector& b, const rational_vector& settled) const {
  rational_vector moves = solver_.solve(b);
  for (std::size_t dof = 0; dof < moves.size(); ++dof)
    if (settled[dof] != 0) moves[dof] = settled[dof];
  return moves;
}

rational_vector position::at_start_of_step() const {
  rational_vector b = before_.force;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const exact_pair& c = problem.pairs[i];
    if (closed[i] != 0) c.add_to(b, rational(c.stiffness * c.face));
  }
  return moved(less_settled(std::move(b), shift_of(before_.settlement, before_.moved, false)),
               shift_of(before_.settlement, before_.moved, true));
}

std::vector<event> position::events_since(const std::vector<char>& before) const {
  std::vector<event> events;
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (closed[i] != before[i])
      events.push_back({static_cast<int>(i), closed[i] != 0 ? change::make : change::break_});
  return events;
}

/// At a fixed dof: K u minus the load and the forces of pairs. If a dof is fixed twice, the first support
/// gets the whole reaction.
rational_vector position::reactions(const rational_vector& displacement,
                                    const rational_vector& forces) const {
  const exact_step& after = problem.steps[step];
  std::set<int> reacted;
  rational_vector values;
  for (const auto& s : problem.supports) {
    rational value = -s.spring * displacement[s.dof];
    if (s.fixed && reacted.insert(s.dof).second) {
      for (const auto& [column, k] : problem.stiffness[s.dof]) value += k * displacement[column];
      value -= before_.force[s.dof] + fraction * (after.force[s.dof] - before_.force[s.dof]) + forces[s.dof];
    }
    values.push_back(std::move(value));
  }
  return values;
}

exact_step_end position::end(path_status status, std::vector<exact_increment> increments,
                             bool pairs_react) const {
  exact_step_end e{std::move(increments), fraction, u, closed, {}, {}, {}, status};
  for (std::size_t dof = 0; dof < u.size(); ++dof) e.displacement[dof] += moved_face(dof);
  rational_vector at_dofs(u.size());
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const exact_pair& c = problem.pairs[i];
    e.gap.push_back(closed[i] != 0 ? rational(0) : gap(i));
    e.force.push_back(closed[i] != 0 ? rational(-c.stiffness * gap(i)) : rational(0));
    if (pairs_react) c.add_to(at_dofs, rational(-c.surface * e.force.back()));
  }
  e.reactions = reactions(e.displacement, at_dofs);
  return e;
}

}  // namespace contct
