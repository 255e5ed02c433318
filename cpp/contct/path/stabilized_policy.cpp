#include "contct/path/stabilized_policy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contct/path/rigid_snap.hpp"

namespace contct::path {

void stabilized_policy::begin_step() {
  kept_in_contact_.clear();
  last_toggled_at_rest_ = -1;
}

response stabilized_policy::respond() {
  rigid_ = !now_.held() && rigid_snap(now_.structure, now_.status, now_.increment, now_.d, now_.d_star);
  if (rigid_) return response::rigid;
  if (!add_holding_springs()) return response::none;
  now_.engine.respond(now_.residual, now_.d_star);
  remove_holding_springs();
  return response::elastic;
}

double stabilized_policy::ask() {
  const double s_min = now_.ask(leader_, d_test(), at_rest_);
  at_rest_ = s_min == 0.0 ? at_rest_ + 1 : 0;
  return s_min;
}

bool stabilized_policy::accept(double& s_min) {
  if (rigid_ && s_min == 1.0) return false;
  // Only the last pairs that hold the structure open too early; any other event is followed.
  if (s_min < 1.0 && !now_.held() && reaches_full_load(s_min)) leave_undone(s_min);
  if (keep_in_contact_if_toggled_again(s_min)) cycles_.reset();
  return true;
}

/// In exact arithmetic d* keeps its sign when its pair is toggled at its face, d' = d / (1 + k F): a pair
/// toggled twice running without progress has a d* of rounding.
bool stabilized_policy::keep_in_contact_if_toggled_again(double s_min) {
  if (s_min > 0.0) {
    begin_step();
    return false;
  }
  if (now_.events.empty()) return false;
  const int pair = now_.events.front().pair;
  if (std::exchange(last_toggled_at_rest_, pair) != pair) return false;
  kept_in_contact_.push_back(pair);
  last_toggled_at_rest_ = -1;
  now_.status[pair] = in_contact;
  if (now_.sprung[pair] == in_contact) now_.events.clear();
  return true;
}

/// d* as the kernel is to see it [pairs].
std::span<const double> stabilized_policy::d_test() {
  if (kept_in_contact_.empty()) return now_.d_star;
  d_test_ = now_.d_star;
  for (const int pair : kept_in_contact_) d_test_[now_.first_there[pair]] = 0.0;
  for (std::size_t i = 0; i < d_test_.size(); ++i) d_test_[i] = d_test_[now_.first_there[i]];
  return d_test_;
}

void stabilized_policy::end_step(int number) {
  const int rounds = 20 + 4 * static_cast<int>(now_.pairs());
  std::vector<double> u(now_.total.size());
  for (int round = 0; round < rounds; ++round) {
    displace(u);
    if (statuses_agree_with(u)) return put_pairs_at(u);
    put_overshot_pairs_on_their_faces();
    for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d_star[i] = u[now_.at_dof[i]] - now_.d[i];
    const double s_min = ask();
    if (now_.events.empty() || !now_.held()) {  // nothing to settle, or only rounding opens the last pair
      now_.take_back_toggles();
      return put_pairs_at(u);
    }
    now_.advance(s_min);
    now_.tell_increment(++number, s_min, false);
    now_.switch_springs();
  }
}

/// Is every pair on the side of its face that its status says? A separated one may be beyond it by rounding
/// of the largest deflection, one in contact off it by rounding of the face.
bool stabilized_policy::statuses_agree_with(std::span<const double> u) const {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  double largest = 0.0;
  for (const std::size_t dof : now_.at_dof) largest = std::max(largest, std::abs(u[dof]));
  for (std::size_t i = 0; i < now_.pairs(); ++i) {
    const double penetration = now_.surface[i] * (u[now_.at_dof[i]] - now_.c[i]);
    const bool agrees = now_.status[i] == in_contact ? penetration >= -4 * eps * std::abs(now_.c[i])
                                                     : penetration <= 32 * eps * largest;
    if (!agrees) return false;
  }
  return true;
}

void stabilized_policy::put_overshot_pairs_on_their_faces() {
  for (std::size_t i = 0; i < now_.pairs(); ++i) {
    double& at = now_.d[now_.first_there[i]];
    if (now_.status[i] * now_.surface[i] * (now_.c[i] - at) < 0) at = now_.c[i];
  }
  for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d[i] = now_.d[now_.first_there[i]];
}

void stabilized_policy::put_pairs_at(std::span<const double> u) {
  for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d[i] = u[now_.at_dof[i]];
}

/// Where supports and pairs in contact leave rigid motions free that the load does not drive, springs of
/// separated pairs hold the structure for a solve, each at rest where its pair is. False when even these do
/// not hold it.
bool stabilized_policy::add_holding_springs() {
  remove_holding_springs();
  rigid_rank rank = now_.held_by();
  const int needed = now_.structure.rigid_motions;
  for (std::size_t i = 0; i < now_.pairs() && rank.rank() < needed; ++i) {
    const int before = rank.rank();
    rank.hold(now_.structure.held_by_pairs[i]);
    if (rank.rank() > before) holding_.push_back(static_cast<int>(i));
  }
  if (rank.rank() < needed) {
    holding_.clear();
    return false;
  }
  for (const int pair : holding_) now_.engine.switch_spring(pair, true);
  return true;
}

void stabilized_policy::remove_holding_springs() {
  for (const int pair : holding_) now_.engine.switch_spring(pair, false);
  holding_.clear();
}

void stabilized_policy::displace(std::span<double> u) {
  std::vector<double> load = now_.applied_load();
  add_holding_springs();
  for (const int pair : holding_)  // no force where the pair is
    load[now_.at_dof[pair]] += now_.structure.pairs[pair].stiffness * now_.d[pair];
  now_.engine.recover(load, now_.forces_by_law(), u);
  remove_holding_springs();
}

double stabilized_policy::reciprocal_condition() {
  add_holding_springs();
  const double rcond = now_.engine.reciprocal_condition();
  remove_holding_springs();
  return rcond;
}

bool stabilized_policy::can_be_held() {
  const bool can = add_holding_springs();
  remove_holding_springs();
  return can;
}

bool stabilized_policy::fall_back(int step) {
  if (!fallback_) return false;
  const std::optional<equilibrium_state> found = fallback_(now_.total);
  if (!found) return false;
  remove_holding_springs();
  for (std::size_t i = 0; i < now_.pairs(); ++i)
    now_.status[i] = found->closed[i] != 0 ? in_contact : separated;
  now_.adopt_statuses();
  put_pairs_at(found->displacement);
  now_.tell_end(step_state{.step = step,
                           .fraction = 1.0,
                           .displacement = found->displacement,
                           .isep = now_.status,
                           .rcond = reciprocal_condition(),
                           .from_fallback = true,
                           .from_reference = true});
  return true;
}

}  // namespace contct::path
