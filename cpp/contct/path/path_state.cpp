#include "contct/path/path_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace contct::path {

path_state::path_state(const linear_structure& structure_of_path, stiffness_engine& e,
                       std::span<observer* const> o, bool as_listed)
    : structure(structure_of_path),
      engine(e),
      total(structure.fixed.size()),
      increment(total.size()),
      d(structure.pairs.size()),
      d_star(structure.pairs.size()),
      s(structure.pairs.size()),
      pair_force(structure.pairs.size()),
      observers_(o),
      as_listed_(as_listed) {
  for (const contact_pair& p : structure.pairs) {
    c.push_back(p.face);
    id.push_back(as_listed ? p.node + 1 : static_cast<int>(id.size()) + 1);
    surface.push_back(p.surface);
    status.push_back(p.closed ? in_contact : separated);
  }
  for (int i = 0; i < static_cast<int>(pairs()); ++i) {
    at_dof.push_back(structure.dof_of_pair(i));
  }
  std::unordered_map<std::size_t, std::size_t> first_at;
  for (std::size_t i = 0; i < pairs(); ++i)
    first_there.push_back(first_at.emplace(at_dof[i], i).first->second);
  if (as_listed) {
    dd_.resize(structure.dofs());
    dtest_.resize(dd_.size());
  }
  sprung = status;
}

void path_state::begin_step(int number, const load_history& total_load) {
  step = number;
  for (std::size_t i = 0; i < total.size(); ++i) increment[i] = -total[i];
  std::fill(total.begin(), total.end(), 0.0);
  total_load(step, total);
  for (std::size_t i = 0; i < total.size(); ++i) increment[i] += total[i];
  residual = {increment, 1.0, residual.version + 1};
  last_opened.clear();
}

double path_state::ask(kernel& leader, std::span<const double> d_test, int at_rest) {
  if (!response_is_finite()) throw no_factor("the response to the residual load is not finite");
  call<double> arguments{d, d_test, c, s, 0.0, id, status, surface, {}, at_rest};
  if (as_listed_) {
    for (std::size_t i = 0; i < pairs(); ++i) {
      dd_[at_dof[i]] = d[i];
      dtest_[at_dof[i]] = d_test[i];
    }
    arguments.dd = dd_;
    arguments.dtest = dtest_;
    arguments.dof = {structure.deflection + 1, structure.dofs_per_node};
  }
  leader.answer(arguments);
  find_events();
  const std::string text = leader.take_text();
  residual.last_s = s;
  for (observer* o : observers_) o->called({arguments, sprung, text});
  return arguments.smin;
}

/// Thousands of pairs, and one or two events: whole stretches are the same.
void path_state::find_events() {
  constexpr std::size_t stretch = 16;
  events.clear();
  const auto look_at = [this](std::size_t i) {
    if (status[i] != sprung[i])
      events.push_back({static_cast<int>(i), status[i] == in_contact ? change::make : change::break_});
  };
  std::size_t i = 0;
  for (; i + stretch <= pairs(); i += stretch) {
    int differs = 0;
    for (std::size_t j = 0; j < stretch; ++j) differs |= status[i + j] ^ sprung[i + j];
    for (std::size_t j = 0; differs != 0 && j < stretch; ++j) look_at(i + j);
  }
  for (; i < pairs(); ++i) look_at(i);
}

void path_state::take_back_toggles() {
  status = sprung;
  events.clear();
}

bool path_state::advance(double s_min) {
  for (std::size_t i = 0; as_listed_ && i < pairs(); ++i) {
    if (sprung[i] == in_contact) pair_force[i] -= structure.pairs[i].stiffness * (s_min * d_star[i]);
  }
  const bool consumes = 1.0 - s_min != 1.0;
  bool moved = consumes;
  for (std::size_t i = 0; !consumes && i < pairs(); ++i) moved |= d[i] + s_min * d_star[i] != d[i];
  for (std::size_t i = 0; i < pairs(); ++i) d[i] += s_min * d_star[i];
  return moved;
}

void path_state::switch_springs() {
  for (const event& e : events) engine.switch_spring(e.pair, e.what == change::make);
  if (std::vector<int> pairs = opened(); !pairs.empty()) last_opened = std::move(pairs);
  sprung = status;
}

void path_state::adopt_statuses() {
  for (std::size_t i = 0; i < pairs(); ++i) {
    if (status[i] != sprung[i]) engine.switch_spring(static_cast<int>(i), status[i] == in_contact);
  }
  sprung = status;
}

rigid_rank path_state::held_by() const {
  rigid_rank rank = structure.nothing_held();
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
  std::array<double, 4> off{};  // sums of zeros, unless there is one that is not finite
  std::size_t i = 0;
  for (; i + off.size() <= d_star.size(); i += off.size())
    for (std::size_t j = 0; j < off.size(); ++j) off[j] += d_star[i + j] - d_star[i + j];
  for (; i < d_star.size(); ++i) off[0] += d_star[i] - d_star[i];
  return off[0] + off[1] + off[2] + off[3] == 0.0;
}

std::vector<int> path_state::opened() const {
  std::vector<int> open;
  for (const event& e : events) {
    if (e.what == change::break_) open.push_back(e.pair);
  }
  return open;
}

std::vector<double> path_state::applied_load() const {
  std::vector<double> applied(total.size());
  for (std::size_t i = 0; i < applied.size(); ++i) applied[i] = total[i] - residual.share * increment[i];
  return applied;
}

std::vector<double> path_state::forces_gathered() const {
  std::vector<double> forces = pair_force;
  for (std::size_t i = 0; i < pairs(); ++i) {
    if (sprung[i] == in_contact) forces[i] += structure.pairs[i].stiffness * d[i];
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

void path_state::tell_increment(int number, double s_min, bool rigid) const {
  for (observer* o : observers_) o->incremented({step, number, s_min, fraction(), events, rigid});
}

void path_state::tell_end(const step_state& end) const {
  for (observer* o : observers_) o->step_ended(end);
}

}  // namespace contct::path
