#include "contct/path/mending.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace contct {

void mending::begin_step() {
  muted_.clear();
  last_at_rest_ = -1;
}

bool mending::lean() {
  stand_up();
  rigid_rank rank = state_.held_by();
  const int needed = state_.structure.rigid_motions;
  if (rank.rank() == needed) return true;
  if (!on_) return false;
  for (std::size_t i = 0; i < state_.pairs() && rank.rank() < needed; ++i) {
    const int before = rank.rank();
    rank.hold(state_.structure.held_by_pairs[i]);
    if (rank.rank() > before) leaning_.push_back(static_cast<int>(i));
  }
  if (rank.rank() < needed) {
    leaning_.clear();
    return false;
  }
  for (const int pair : leaning_) engine_.switch_spring(pair, true);
  return true;
}

void mending::stand_up() {
  for (const int pair : leaning_) engine_.switch_spring(pair, false);
  leaning_.clear();
}

void mending::hold_at_rest(std::span<double> load) const {
  for (const int pair : leaning_) {
    const auto i = static_cast<std::size_t>(pair);
    load[state_.at_dof[i]] += state_.structure.pairs[i].stiffness * state_.d[i];
  }
}

bool mending::mute(double s_min) {
  if (s_min > 0.0) {
    begin_step();
    return false;
  }
  if (state_.events.empty()) return false;
  const int pair = state_.events.front().pair;
  if (std::exchange(last_at_rest_, pair) != pair) return false;
  const auto i = static_cast<std::size_t>(pair);
  muted_.push_back(pair);
  last_at_rest_ = -1;
  state_.status[i] = in_contact;
  if (state_.sprung[i] == in_contact) state_.events.clear();
  return true;
}

std::span<const double> mending::d_test() {
  if (muted_.empty()) return state_.d_star;
  d_test_ = state_.d_star;
  for (const int pair : muted_) d_test_[state_.first_there[static_cast<std::size_t>(pair)]] = 0.0;
  for (std::size_t i = 0; i < d_test_.size(); ++i) d_test_[i] = d_test_[state_.first_there[i]];
  return d_test_;
}

bool mending::obeys(std::span<const double> u) const {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  double largest = 0.0;
  for (const std::size_t dof : state_.at_dof) largest = std::max(largest, std::abs(u[dof]));
  for (std::size_t i = 0; i < state_.pairs(); ++i) {
    const double pressing = state_.surface[i] * (u[state_.at_dof[i]] - state_.c[i]);
    const bool right = state_.status[i] == in_contact ? pressing >= -4 * eps * std::abs(state_.c[i])
                                                      : pressing <= 32 * eps * largest;
    if (!right) return false;
  }
  return true;
}

void mending::put_on_faces() {
  for (std::size_t i = 0; i < state_.pairs(); ++i) {
    double& at = state_.d[state_.first_there[i]];
    if (state_.status[i] * state_.surface[i] * (state_.c[i] - at) < 0) at = state_.c[i];
  }
  for (std::size_t i = 0; i < state_.pairs(); ++i) state_.d[i] = state_.d[state_.first_there[i]];
}

}  // namespace contct
