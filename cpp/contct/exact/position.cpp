#include "contct/exact/position.hpp"

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
  exact_step more = problem.steps[number];
  add(more.force, before_.force, -1);
  add(more.settlement, before_.settlement, -1);
  add(more.moved, before_.moved, -1);
  more = problem.from_faces(std::move(more));
  increment_ = std::move(more.force);
  settlement_ = std::move(more.settlement);
}

void position::unload() {
  u.assign(problem.dofs(), rational());
  before_ = {u, {}, u, u};
  isep = statuses_at_start(problem.pairs);
}

void position::factor() {
  std::vector<added_spring> springs;
  for (std::size_t i = 0; i < isep.size(); ++i)
    if (isep[i] == in_contact)
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
  exact_step l = before_;
  for (std::size_t i = 0; i < isep.size(); ++i) {
    const exact_pair& c = problem.pairs[i];
    if (isep[i] == in_contact) c.add_to(l.force, rational(c.stiffness * c.face));
  }
  l = problem.from_faces(std::move(l));
  return moved(l.force, l.settlement);
}

std::vector<event> position::events_since(const std::vector<int>& before) const {
  std::vector<event> events;
  for (std::size_t i = 0; i < isep.size(); ++i)
    if (isep[i] != before[i])
      events.push_back({static_cast<int>(i), isep[i] == in_contact ? change::make : change::break_});
  return events;
}

exact_step_end position::end(path_status status, std::vector<exact_increment> increments,
                             bool pairs_react) const {
  exact_step_end e{std::move(increments), fraction, u, isep, {}, {}, {}, status};
  for (std::size_t dof = 0; dof < u.size(); ++dof) e.displacement[dof] += moved_face(dof);
  rational_vector pressing(u.size());  // the forces of the pairs, against the structure
  for (std::size_t i = 0; i < isep.size(); ++i) {
    const exact_pair& c = problem.pairs[i];
    e.gap.push_back(gap_of(c, c.seen_in(u), isep[i] == in_contact));
    e.force.push_back(force_of(c, c.seen_in(u), isep[i] == in_contact));
    if (pairs_react) c.add_to(pressing, rational(c.surface * e.force.back()));
  }
  for (const exact_pair& h : problem.held) exact_problem::add_pressing(h, u, pressing);
  const exact_step& after = problem.steps[step];
  const auto needed = [&](int dof) {
    const rational load = before_.force[dof] + fraction * (after.force[dof] - before_.force[dof]);
    return problem.add_row(dof, e.displacement, rational(pressing[dof] - load));
  };
  for (const auto& s : problem.supports) e.reactions.push_back(s.force(e.displacement, needed));
  return e;
}

exact_path exact_rule::follow() {
  exact_path path;
  bool stands = true;  // the step before was solved
  for (std::size_t step = 0; step < at_.problem.steps.size(); ++step) {
    if (!stands && !at_.problem.steps[step].from_zero) break;
    at_.begin_step(step);
    increments_.clear();
    const path_status status = follow_step();
    stands = status == path_status::solved;
    path.steps.push_back(at_.end(status, std::move(increments_), pairs_react_));
  }
  path.mechanism = std::move(mechanism_);
  return path;
}

bool exact_rule::begin_increment(std::size_t number) const {
  if (number > 1000 + 50 * at_.problem.pairs.size()) return false;
  if (tell_) tell_(static_cast<int>(at_.step) + 1, static_cast<int>(number), at_.fraction);
  return true;
}

}  // namespace contct
