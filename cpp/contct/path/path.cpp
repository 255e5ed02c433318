#include "contct/path/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "contct/path/rigid_snap.hpp"
#include "contct/path/standstill.hpp"
#include "contct/structure/rigid_modes.hpp"

namespace contct {
namespace {

/// Everything that changes along the path, in the paper's words.
class path {
 public:
  path(const linear_structure& s, stiffness_engine& engine, kernel& leader,
       std::span<observer* const> observers, int increments_allowed, const rescuer& rescue)
      : structure_(s),
        engine_(engine),
        leader_(leader),
        observers_(observers),
        increments_allowed_(increments_allowed),
        rescue_(rescue),
        mends_(leader.facts().rule != "listing"),
        d_(static_cast<std::size_t>(s.dofs())),
        d_star_(static_cast<std::size_t>(s.dofs())),
        d_test_(static_cast<std::size_t>(s.dofs())),
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
    if (!held() && !mends_) return never_held(step);
    for (int number = 1; number <= increments_allowed_; ++number) {
      const bool snaps = !held() && rigid_snap(structure_, status_, residual.increment, d_, d_star_);
      if (!snaps && !respond(residual)) return set_free(step, residual);  // K w* = R*
      if (!response_is_finite()) return stop(path_status::not_factored, step, residual, {});
      double s_min = ask_kernel();
      if (snaps && s_min == 1.0) return set_free(step, residual);
      if (s_min < 1.0 && falls_at_full_load(residual.share * (1.0 - s_min))) s_min = leave_undone();
      if (mends_) mute(s_min);
      const bool moved = advance(s_min);          // D <- D + s_min d*
      if (!snaps) residual.share *= 1.0 - s_min;  // R* <- (1 - s_min) R*
      fraction_ = 1.0 - residual.share;
      tell_increment(step, number, s_min, residual, snaps);
      if (!held() && !mends_) return stop(path_status::mechanism, step, residual, opened(events_));
      switch_springs();
      if (s_min == 1.0) {
        if (mends_) settle(step, number, residual);
        return stop(path_status::solved, step, residual, {});
      }
      if (standstill_.repeats(moved, status_, events_)) {
        return stop(path_status::cycle, step, residual, standstill_.restless_pairs());
      }
    }
    return stop(path_status::iteration_limit, step, residual, standstill_.restless_pairs());
  }

  /// The share of the step's load applied by now.
  [[nodiscard]] double fraction() const { return fraction_; }

  /// The step could not be followed to its end: go on from an equilibrium that comes from
  /// elsewhere, if the leader's rule allows it and there is one.
  bool rescued(int step) {
    if (!mends_ || !rescue_) return false;
    const std::optional<rest_state> found = rescue_(total_);
    if (!found) return false;
    for (const int dof : watched_) d_[at(dof)] = found->displacement[at(dof)];
    for (std::size_t i = 0; i < status_.size(); ++i) {
      status_[i] = found->closed[i] != 0 ? in_contact : separated;
      if (status_[i] != sprung_[i]) engine_.switch_spring(static_cast<int>(i), status_[i] == in_contact);
    }
    sprung_ = status_;
    for (observer* o : observers_) o->step_ended({step, 1.0, found->displacement, status_, rcond(), true});
    return true;
  }

 private:
  std::span<const double> begin_step(int step, const load_history& total_load) {
    std::transform(total_.begin(), total_.end(), increment_.begin(), [](double before) { return -before; });
    std::fill(total_.begin(), total_.end(), 0.0);
    total_load(step, total_);
    std::transform(total_.begin(), total_.end(), increment_.begin(), increment_.begin(), std::plus<>());
    standstill_.reset();
    fraction_ = 0.0;
    muted_.clear();
    last_at_rest_ = -1;
    last_opened_.clear();
    return increment_;
  }

  /// The rigid motions that supports and closed pairs stop.
  [[nodiscard]] rigid_rank held_by_now() const {
    rigid_rank rank;
    for (const rigid_row& row : structure_.held_by_supports) rank.hold(row);
    for (std::size_t i = 0; i < status_.size(); ++i) {
      if (status_[i] == in_contact) rank.hold(structure_.held_by_pairs[i]);
    }
    return rank;
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

  /// d* of the residual load. False when the structure is free and cannot lean on anything.
  bool respond(const residual_load& residual) {
    if (!lean()) return false;
    engine_.respond(residual, d_star_);
    stand_up();
    return true;
  }

  /// Where supports and closed pairs leave a motion free that the load does not drive, put springs
  /// of open pairs in, at rest where they stand: they hold the structure and have nothing to do.
  /// False when even all of them do not hold it.
  bool lean() {
    if (held()) return true;
    if (!mends_) return false;
    rigid_rank rank = held_by_now();
    for (std::size_t i = 0; i < status_.size() && rank.rank() < structure_.rigid_motions; ++i) {
      const int before = rank.rank();
      rank.hold(structure_.held_by_pairs[i]);
      if (rank.rank() > before) leaning_.push_back(static_cast<int>(i));
    }
    if (rank.rank() < structure_.rigid_motions) leaning_.clear();
    for (const int pair : leaning_) engine_.switch_spring(pair, true);
    return !leaning_.empty();
  }

  void stand_up() {
    for (const int pair : leaning_) engine_.switch_spring(pair, false);
    leaning_.clear();
  }

  /// A pair toggled twice running without any progress: its d* is rounding. It stays closed, and is
  /// not asked again until the load advances.
  void mute(double s_min) {
    if (s_min > 0.0) {
      muted_.clear();
      last_at_rest_ = -1;
      return;
    }
    if (events_.empty()) return;
    const int pair = events_.front().pair;
    if (std::exchange(last_at_rest_, pair) != pair) return;
    muted_.push_back(pair);
    last_at_rest_ = -1;
    standstill_.reset();
    status_[static_cast<std::size_t>(pair)] = in_contact;
    if (sprung_[static_cast<std::size_t>(pair)] == in_contact) events_.clear();
  }

  /// The load is applied: put D where the springs' own law has it, and let the kernel mend what
  /// rounding left behind on the way: the response is then to what is out of balance.
  void settle(int step, int number, const residual_load& residual) {
    const residual_load whole{residual.increment, 0.0};
    const int rounds = 20 + 4 * static_cast<int>(status_.size());
    for (int round = 0; round < rounds; ++round) {
      const std::vector<double> u = displacement(whole);
      const bool right = obeys(u);
      if (!right) {
        put_on_faces();
        for (const int dof : watched_) d_star_[at(dof)] = u[at(dof)] - d_[at(dof)];
        const double s_min = ask_kernel();
        if (!events_.empty() && held()) {
          advance(s_min);
          tell_increment(step, ++number, s_min, whole, false);
          switch_springs();
          continue;
        }
        leave_undone();  // nothing to mend, or only rounding opens the last pairs that hold
      }
      for (const int dof : watched_) d_[at(dof)] = u[at(dof)];
      return;
    }
  }

  /// Does every pair stand on the side of its face that its status says? An open one may be beyond
  /// it by rounding of the largest deflection, a closed one by rounding of its face.
  [[nodiscard]] bool obeys(std::span<const double> u) const {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    double largest = 0.0;
    for (const int dof : watched_) largest = std::max(largest, std::abs(u[at(dof)]));
    for (std::size_t i = 0; i < status_.size(); ++i) {
      const double pressing = surface_[i] * (u[dof_of(i)] - c_[i]);
      if (status_[i] == in_contact ? pressing < -4 * eps * std::abs(c_[i]) : pressing > 32 * eps * largest)
        return false;
    }
    return true;
  }

  /// A pair beyond its face, whatever its status, has got there by rounding.
  void put_on_faces() {
    for (std::size_t i = 0; i < status_.size(); ++i) {
      if (status_[i] * surface_[i] * (c_[i] - d_[dof_of(i)]) < 0) d_[dof_of(i)] = c_[i];
    }
  }

  [[nodiscard]] static std::size_t at(int dof) { return static_cast<std::size_t>(dof); }
  [[nodiscard]] std::size_t dof_of(std::size_t pair) const {
    return static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(pair)));
  }

  double ask_kernel() {
    for (const int dof : watched_) d_test_[at(dof)] = d_star_[at(dof)];
    for (const int pair : muted_) d_test_[dof_of(static_cast<std::size_t>(pair))] = 0.0;
    call<double> c{d_,      d_test_,  c_,
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
    if (mends_ && held()) return false;  // only where the last pairs that hold would open
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
    if (std::vector<int> pairs = opened(events_); !pairs.empty()) last_opened_ = std::move(pairs);
    sprung_ = status_;
  }

  [[nodiscard]] static std::vector<int> opened(std::span<const event> events) {
    std::vector<int> pairs;
    for (const event& e : events) {
      if (e.what == change::break_) pairs.push_back(e.pair);
    }
    return pairs;
  }

  void tell_increment(int step, int number, double s_min, const residual_load& residual, bool snaps) {
    for (observer* o : observers_)
      o->incremented({step, number, s_min, 1.0 - residual.share, events_, snaps});
  }

  /// The displacement of every dof now, under the load applied so far.
  std::vector<double> displacement(const residual_load& residual) {
    std::vector<double> applied(total_.size());
    for (std::size_t i = 0; i < applied.size(); ++i) applied[i] = total_[i] - residual.share * increment_[i];
    const std::vector<double> forces = mends_ ? forces_by_law() : forces_gathered();
    std::vector<double> u(applied.size());
    lean();
    for (const int pair : leaning_) applied[dof_of(static_cast<std::size_t>(pair))] += rest_force(pair);
    engine_.recover(applied, forces, u);
    stand_up();
    return u;
  }

  /// What keeps the spring of a leaning pair at rest where it stands.
  [[nodiscard]] double rest_force(int pair) const {
    const auto i = static_cast<std::size_t>(pair);
    return structure_.pairs[i].stiffness * d_[dof_of(i)];
  }

  /// The part of the springs' forces that does not depend on D: each spring in the engine with the
  /// force that it has gathered, the 1989 way, whatever its law says.
  [[nodiscard]] std::vector<double> forces_gathered() const {
    std::vector<double> forces = pair_force_;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      if (sprung_[i] == in_contact) forces[i] += structure_.pairs[i].stiffness * d_[dof_of(i)];
    }
    return forces;
  }

  /// The same by the law k (c - D) of a closed spring: k c.
  [[nodiscard]] std::vector<double> forces_by_law() const {
    std::vector<double> forces(status_.size());
    for (std::size_t i = 0; i < forces.size(); ++i) {
      if (sprung_[i] == in_contact) forces[i] = structure_.pairs[i].stiffness * structure_.pairs[i].face;
    }
    return forces;
  }

  /// Nothing holds the structure from the start: it has not moved, and nothing can be solved.
  path_end never_held(int step) {
    if (rescued(step)) return {path_status::solved, step, 1.0, {}};
    const std::vector<double> u(d_.size());
    for (observer* o : observers_) o->step_ended({step, 0.0, u, status_, 0.0, false});
    return {path_status::mechanism, step, 0.0, {}};
  }

  /// Nothing stops the structure: the state reached is the one in which the pairs that opened last
  /// were about to, and their springs, at rest, still hold it.
  path_end set_free(int step, const residual_load& residual) {
    const std::vector<int> pairs = last_opened_;
    for (const int pair : pairs) {
      if (status_[static_cast<std::size_t>(pair)] == in_contact) continue;
      status_[static_cast<std::size_t>(pair)] = in_contact;
      engine_.switch_spring(pair, true);
    }
    sprung_ = status_;
    if (!held()) return never_held(step);
    return stop(path_status::mechanism, step, residual, pairs);
  }

  /// Of the springs now in, and of those that the structure leans on.
  double rcond() {
    lean();
    const double estimate = engine_.reciprocal_condition();
    stand_up();
    return estimate;
  }

  /// Tell the state reached, and end.
  path_end stop(path_status status, int step, const residual_load& residual, std::vector<int> pairs) {
    const double fraction = 1.0 - residual.share;
    if (status != path_status::solved && rescued(step)) return {path_status::solved, step, 1.0, {}};
    if (status == path_status::not_factored) return {status, step, fraction, {}};
    const std::vector<double> u = displacement(residual);
    if (!std::all_of(u.begin(), u.end(), [](double x) { return std::isfinite(x); })) {
      return {path_status::not_factored, step, fraction, {}};
    }
    for (observer* o : observers_) o->step_ended({step, fraction, u, status_, rcond(), false});
    return {status, step, fraction, std::move(pairs)};
  }

  const linear_structure& structure_;
  stiffness_engine& engine_;
  kernel& leader_;
  std::span<observer* const> observers_;
  int increments_allowed_;
  const rescuer& rescue_;
  bool mends_;  // the leader follows another rule than the listing's

  std::vector<double> d_;           // D [dofs], kept up to date at the watched dofs
  std::vector<double> d_star_;      // d* [dofs]
  std::vector<double> d_test_;      // d* as the kernel sees it [dofs]
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
  std::vector<int> leaning_;        // open pairs whose springs hold a motion that nothing drives
  std::vector<int> last_opened_;    // by the last increment that opened any
  std::vector<int> muted_;          // pairs that are not asked
  int last_at_rest_ = -1;           // the pair toggled last without progress
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
  path p(s, engine, leader, observers, increments_allowed(limits, s.pairs.size()), limits.rescue);
  path_end end;
  for (int step = 1; step <= steps && end.status == path_status::solved; ++step) {
    try {
      end = p.follow_step(step, total_load);
    } catch (const no_factor&) {
      end = {p.rescued(step) ? path_status::solved : path_status::not_factored, step, p.fraction(), {}};
    }
  }
  return end;
}

}  // namespace contct
