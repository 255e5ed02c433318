#include "contct/path/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/path/standstill.hpp"
#include "contct/structure/rigid_modes.hpp"

namespace contct {
namespace {

/// Everything that changes along the path, in the paper's words.
class path {
 public:
  path(const linear_structure& s, stiffness_engine& engine, kernel& leader,
       std::span<observer* const> observers, int increments_allowed)
      : structure_(s),
        engine_(engine),
        leader_(leader),
        observers_(observers),
        increments_allowed_(increments_allowed),
        d_(static_cast<std::size_t>(s.dofs())),
        d_star_(static_cast<std::size_t>(s.dofs())),
        total_(static_cast<std::size_t>(s.dofs())),
        increment_(static_cast<std::size_t>(s.dofs())),
        s_(s.pairs.size()),
        pair_force_(s.pairs.size()),
        standstill_(s.pairs.size()) {
    for (const contact_pair& p : s.pairs) {
      c_.push_back(p.face);
      node_.push_back(p.node + 1);
      surface_.push_back(p.surface);
      status_.push_back(p.closed ? in_contact : separated);
    }
    for (int i = 0; i < static_cast<int>(s.pairs.size()); ++i) watched_.push_back(s.dof_of_pair(i));
    std::sort(watched_.begin(), watched_.end());
    watched_.erase(std::unique(watched_.begin(), watched_.end()), watched_.end());
    sprung_ = status_;
  }

  /// The paper's loop, for one load step.
  path_end follow_step(int step, const load_history& total_load) {
    residual_load residual{begin_step(step, total_load), 1.0};
    if (!held()) return never_held(step);
    for (int number = 1; number <= increments_allowed_; ++number) {
      engine_.respond(residual, d_star_);  // K w* = R*
      if (!response_is_finite()) return stop(path_status::not_factored, step, residual, {});
      double s_min = ask_kernel();
      if (s_min < 1.0 && falls_at_full_load(residual.share * (1.0 - s_min))) s_min = leave_undone();
      const bool moved = advance(s_min);  // D <- D + s_min d*
      residual.share *= 1.0 - s_min;      // R* <- (1 - s_min) R*
      fraction_ = 1.0 - residual.share;
      tell_increment(step, number, s_min, residual);
      if (!held()) return stop(path_status::mechanism, step, residual, opened());
      switch_springs();
      if (s_min == 1.0) return stop(path_status::solved, step, residual, {});
      if (standstill_.repeats(moved, status_, events_)) {
        return stop(path_status::cycle, step, residual, standstill_.restless_pairs());
      }
    }
    return stop(path_status::iteration_limit, step, residual, standstill_.restless_pairs());
  }

  /// The share of the step's load applied by now.
  [[nodiscard]] double fraction() const { return fraction_; }

 private:
  std::span<const double> begin_step(int step, const load_history& total_load) {
    std::transform(total_.begin(), total_.end(), increment_.begin(), [](double before) { return -before; });
    std::fill(total_.begin(), total_.end(), 0.0);
    total_load(step, total_);
    std::transform(total_.begin(), total_.end(), increment_.begin(), increment_.begin(), std::plus<>());
    standstill_.reset();
    fraction_ = 0.0;
    return increment_;
  }

  /// Do the supports and the closed pairs stop every rigid motion?
  [[nodiscard]] bool held() const {
    rigid_rank rank;
    for (const rigid_row& row : structure_.held_by_supports) {
      rank.hold(row);
      if (rank.rank() == structure_.rigid_motions) return true;
    }
    for (std::size_t i = 0; i < status_.size(); ++i) {
      if (status_[i] == in_contact) rank.hold(structure_.held_by_pairs[i]);
      if (rank.rank() == structure_.rigid_motions) return true;
    }
    return rank.rank() == structure_.rigid_motions;
  }

  [[nodiscard]] bool response_is_finite() const {
    return std::all_of(watched_.begin(), watched_.end(),
                       [this](int dof) { return std::isfinite(d_star_[static_cast<std::size_t>(dof)]); });
  }

  double ask_kernel() {
    call<double> c{d_,      d_star_,  c_,
                   s_,      0.0,      node_,
                   status_, surface_, {structure_.deflection + 1, structure_.dofs_per_node}};
    leader_.answer(c);
    events_.clear();
    for (std::size_t i = 0; i < status_.size(); ++i) {
      if (status_[i] != sprung_[i]) {
        events_.push_back({static_cast<int>(i), status_[i] == in_contact ? change::make : change::break_});
      }
    }
    const std::string text = leader_.take_text();
    for (observer* o : observers_) o->called({c, sprung_, text});
    return c.smin;
  }

  /// Is a share of the step's load that is still left no more than the error of an event's load?
  /// Unloading to nothing opens the last pairs exactly at full load; computed, that may come a
  /// rounding too early, with about eps / rcond of the load still to go, and the listing's mark for
  /// "no event" then takes every quiet pair along.
  [[nodiscard]] bool falls_at_full_load(double share_left) {
    constexpr double never_less = 1e-9;
    constexpr double never_more = 1e-6;
    if (share_left > never_more) return false;
    if (share_left <= never_less) return true;
    return share_left <= std::numeric_limits<double>::epsilon() / engine_.reciprocal_condition();
  }

  /// Take the kernel's toggles back and apply the whole rest: an event exactly at full load is left
  /// undone, as the listing itself leaves one whose s is 1.
  double leave_undone() {
    status_ = sprung_;
    events_.clear();
    return 1.0;
  }

  /// Move the watched dofs, and with them the forces in the closed springs. False when nothing
  /// moved to the last bit.
  bool advance(double s_min) {
    for (std::size_t i = 0; i < pair_force_.size(); ++i) {
      if (sprung_[i] == in_contact) {
        const auto dof = static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)));
        pair_force_[i] -= structure_.pairs[i].stiffness * (s_min * d_star_[dof]);
      }
    }
    bool moved = 1.0 - s_min != 1.0;
    for (const int dof : watched_) {
      const double before = d_[static_cast<std::size_t>(dof)];
      d_[static_cast<std::size_t>(dof)] += s_min * d_star_[static_cast<std::size_t>(dof)];
      moved = moved || d_[static_cast<std::size_t>(dof)] != before;
    }
    return moved;
  }

  void switch_springs() {
    for (const event& e : events_) engine_.switch_spring(e.pair, e.what == change::make);
    sprung_ = status_;
  }

  [[nodiscard]] std::vector<int> opened() const {
    std::vector<int> pairs;
    for (const event& e : events_) {
      if (e.what == change::break_) pairs.push_back(e.pair);
    }
    return pairs;
  }

  void tell_increment(int step, int number, double s_min, const residual_load& residual) {
    for (observer* o : observers_) o->incremented({step, number, s_min, 1.0 - residual.share, events_});
  }

  /// The displacement of every dof now: that of the springs in the engine, each with the force
  /// that it has gathered, under the load applied so far.
  std::vector<double> displacement(const residual_load& residual) {
    std::vector<double> applied(total_.size());
    for (std::size_t i = 0; i < applied.size(); ++i) applied[i] = total_[i] - residual.share * increment_[i];
    std::vector<double> forces = pair_force_;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const auto dof = static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)));
      if (sprung_[i] == in_contact) forces[i] += structure_.pairs[i].stiffness * d_[dof];
    }
    std::vector<double> u(applied.size());
    engine_.recover(applied, forces, u);
    return u;
  }

  /// Nothing holds the structure from the start: it has not moved, and nothing can be solved.
  path_end never_held(int step) {
    const std::vector<double> u(d_.size());
    for (observer* o : observers_) o->step_ended({step, 0.0, u, status_, 0.0});
    return {path_status::mechanism, step, 0.0, {}};
  }

  /// Tell the state reached, and end.
  path_end stop(path_status status, int step, const residual_load& residual, std::vector<int> pairs) {
    const double fraction = 1.0 - residual.share;
    if (status == path_status::not_factored) return {status, step, fraction, {}};
    const std::vector<double> u = displacement(residual);
    if (!std::all_of(u.begin(), u.end(), [](double x) { return std::isfinite(x); })) {
      return {path_status::not_factored, step, fraction, {}};
    }
    const double rcond = engine_.reciprocal_condition();
    for (observer* o : observers_) o->step_ended({step, fraction, u, status_, rcond});
    return {status, step, fraction, std::move(pairs)};
  }

  const linear_structure& structure_;
  stiffness_engine& engine_;
  kernel& leader_;
  std::span<observer* const> observers_;
  int increments_allowed_;

  std::vector<double> d_;           // D [dofs], kept up to date at the watched dofs
  std::vector<double> d_star_;      // d* [dofs]
  std::vector<double> total_;       // total load at the end of the step [dofs]
  std::vector<double> increment_;   // total less the previous step's [dofs]
  std::vector<double> c_;           // faces [pairs]
  std::vector<double> s_;           // scale factors [pairs]
  std::vector<int> node_;           // ID [pairs]
  std::vector<int> status_;         // ISEP [pairs]
  std::vector<int> sprung_;         // status of each pair in the engine's stiffness [pairs]
  std::vector<int> surface_;        // ISURF [pairs]
  std::vector<int> watched_;        // dofs where pairs act, once each
  std::vector<double> pair_force_;  // force on the structure gathered by each spring [pairs]
  std::vector<event> events_;       // of the last call
  double fraction_ = 0.0;           // share of the step's load applied by now
  standstill standstill_;
};

}  // namespace

int increments_allowed(const path_limits& limits, std::size_t pairs) {
  constexpr std::size_t most = most_increments;
  if (limits.increments_per_step > 0) return std::min(limits.increments_per_step, most_increments);
  return static_cast<int>(std::min(most, 1000 + 50 * std::min(most, pairs)));
}

path_end follow_path(const linear_structure& s, int steps, const load_history& total_load,
                     stiffness_engine& engine, kernel& leader, std::span<observer* const> observers,
                     const path_limits& limits) {
  path p(s, engine, leader, observers, increments_allowed(limits, s.pairs.size()));
  path_end end;
  for (int step = 1; step <= steps && end.status == path_status::solved; ++step) {
    try {
      end = p.follow_step(step, total_load);
    } catch (const no_factor&) {
      end = {path_status::not_factored, step, p.fraction(), {}};
    }
  }
  return end;
}

}  // namespace contct
