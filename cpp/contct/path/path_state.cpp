#include "contct/path/path_state.hpp"

#include <algorithm>
#include <cmath>

namespace contct {

path_state::path_state(const linear_structure& structure_of_path)
    : structure(structure_of_path),
      d(static_cast<std::size_t>(structure.dofs())),
      d_star(static_cast<std::size_t>(structure.dofs())),
      s(structure.pairs.size()),
      pair_force(structure.pairs.size()) {
  for (const contact_pair& p : structure.pairs) {
    c.push_back(p.face);
    node.push_back(p.node + 1);
    surface.push_back(p.surface);
    status.push_back(p.closed ? in_contact : separated);
  }
  for (int i = 0; i < static_cast<int>(pairs()); ++i) {
    at_dof.push_back(static_cast<std::size_t>(structure.dof_of_pair(i)));
    watched.push_back(structure.dof_of_pair(i));
  }
  std::sort(watched.begin(), watched.end());
  watched.erase(std::unique(watched.begin(), watched.end()), watched.end());
  sprung = status;
}

double path_state::ask(kernel& leader, std::span<const double> d_test, std::span<observer* const> observers) {
  call<double> arguments{
      d, d_test, c, s, 0.0, node, status, surface, {structure.deflection + 1, structure.dofs_per_node}};
  leader.answer(arguments);
  events.clear();
  for (std::size_t i = 0; i < pairs(); ++i) {
    if (status[i] != sprung[i]) {
      events.push_back({static_cast<int>(i), status[i] == in_contact ? change::make : change::break_});
    }
  }
  const std::string text = leader.take_text();
  for (observer* o : observers) o->called({arguments, sprung, text});
  return arguments.smin;
}

void path_state::take_back_toggles() {
  status = sprung;
  events.clear();
}

bool path_state::advance(double s_min, bool gathers) {
  for (std::size_t i = 0; gathers && i < pairs(); ++i) {
    if (sprung[i] == in_contact) pair_force[i] -= structure.pairs[i].stiffness * (s_min * d_star[dof_of(i)]);
  }
  bool moved = 1.0 - s_min != 1.0;
  for (const int dof : watched) {
    const auto at = static_cast<std::size_t>(dof);
    const double before = d[at];
    d[at] += s_min * d_star[at];
    moved = moved || d[at] != before;
  }
  return moved;
}

rigid_rank path_state::held_by() const {
  rigid_rank rank;
  for (const rigid_row& row : structure.held_by_supports) {
    if (rank.rank() == structure.rigid_motions) return rank;
    rank.hold(row);
  }
  for (std::size_t i = 0; i < pairs() && rank.rank() < structure.rigid_motions; ++i) {
    if (status[i] == in_contact) rank.hold(structure.held_by_pairs[i]);
  }
  return rank;
}

bool path_state::held() const {
  return held_by().rank() == structure.rigid_motions;
}

bool path_state::response_is_finite() const {
  double sum = 0.0;  // of zeros, unless one is infinite or NaN
  for (const int dof : watched) sum += 0.0 * d_star[static_cast<std::size_t>(dof)];
  return sum == 0.0;
}

std::vector<int> path_state::opened() const {
  std::vector<int> open;
  for (const event& e : events) {
    if (e.what == change::break_) open.push_back(e.pair);
  }
  return open;
}

std::vector<double> path_state::forces_gathered() const {
  std::vector<double> forces = pair_force;
  for (std::size_t i = 0; i < pairs(); ++i) {
    if (sprung[i] == in_contact) forces[i] += structure.pairs[i].stiffness * d[dof_of(i)];
  }
  return forces;
}

std::vector<double> path_state::forces_by_law() const {
  std::vector<double> forces(pairs());
  for (std::size_t i = 0; i < pairs(); ++i) {
    if (sprung[i] == in_contact) forces[i] = structure.pairs[i].stiffness * c[i];
  }
  return forces;
}

}  // namespace contct
