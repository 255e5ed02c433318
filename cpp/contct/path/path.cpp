#include "contct/path/path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "contct/path/cycle_detector.hpp"
#include "contct/path/mending.hpp"
#include "contct/path/path_state.hpp"
#include "contct/path/rigid_snap.hpp"

namespace contct {
namespace {

/// The loop, and how it ends.
class path {
 public:
  path(const linear_structure& s, stiffness_engine& engine, kernel& leader,
       std::span<observer* const> observers, int increments_allowed, const fallback_solver& fallback)
      : now_(s, leader.facts().rule == "listing"),
        engine_(engine),
        leader_(leader),
        observers_(observers),
        increments_allowed_(increments_allowed),
        rescue_(fallback),
        mend_(now_, engine, leader.facts().rule != "listing"),
        total_(static_cast<std::size_t>(s.dofs())),
        increment_(static_cast<std::size_t>(s.dofs())),
        cycles_(s.pairs.size()) {}

  /// The paper's loop, for one load step.
  path_end follow_step(int step, const load_history& total_load) {
    begin_step(step, total_load);
    residual_load residual{increment_, 1.0, ++version_};
    if (!now_.held() && !mend_.on()) return never_held(step);
    for (int number = 1; number <= increments_allowed_; ++number) {
      const bool snaps =
          !now_.held() && rigid_snap(now_.structure, now_.status, increment_, now_.d, now_.d_star);
      if (!snaps && !respond(residual)) return set_free(step, residual);  // K w* = R*
      if (!now_.response_is_finite()) return stop(path_status::not_factored, step, residual, {});
      double s_min = now_.ask(leader_, mend_.d_test(), observers_);
      if (snaps && s_min == 1.0) return set_free(step, residual);
      if (s_min < 1.0 && falls_at_full_load(residual.share * (1.0 - s_min))) s_min = leave_undone();
      if (mend_.on() && mend_.mute(s_min)) cycles_.reset();
      residual.last_s = now_.s;
      const bool moved = now_.advance(s_min, !mend_.on());  // D <- D + s_min d*
      if (!snaps) residual.share *= 1.0 - s_min;            // R* <- (1 - s_min) R*
      fraction_ = 1.0 - residual.share;
      tell_increment(step, number, s_min, snaps);
      if (!now_.held() && !mend_.on()) return stop(path_status::mechanism, step, residual, now_.opened());
      switch_springs();
      if (s_min == 1.0) {
        if (mend_.on()) settle(step, number);
        return stop(path_status::solved, step, residual, {});
      }
      if (cycles_.repeats(moved, now_.status, now_.events)) {
        return stop(path_status::cycle, step, residual, cycles_.restless_pairs());
      }
    }
    return stop(path_status::iteration_limit, step, residual, cycles_.restless_pairs());
  }

  /// The share of the step's load applied by now.
  [[nodiscard]] double fraction() const { return fraction_; }

  /// The step could not be followed to its end: go on from an equilibrium that comes from
  /// elsewhere, if the leader's rule allows it and there is one.
  bool from_fallback(int step) {
    if (!mend_.on() || !rescue_) return false;
    const std::optional<equilibrium_state> found = rescue_(total_);
    if (!found) return false;
    mend_.stand_up();
    for (std::size_t i = 0; i < now_.pairs(); ++i) {
      now_.status[i] = found->closed[i] != 0 ? in_contact : separated;
      if (now_.status[i] != now_.sprung[i]) {
        engine_.switch_spring(static_cast<int>(i), now_.status[i] == in_contact);
      }
    }
    now_.sprung = now_.status;
    put_at(found->displacement);
    tell_end(step, 1.0, found->displacement, true);
    return true;
  }

 private:
  void begin_step(int step, const load_history& total_load) {
    std::transform(total_.begin(), total_.end(), increment_.begin(), [](double before) { return -before; });
    std::fill(total_.begin(), total_.end(), 0.0);
    total_load(step, total_);
    std::transform(total_.begin(), total_.end(), increment_.begin(), increment_.begin(), std::plus<>());
    cycles_.reset();
    mend_.begin_step();
    last_opened_.clear();
    fraction_ = 0.0;
  }

  /// d* of the residual load. False when the structure is free and cannot lean on anything.
  bool respond(const residual_load& residual) {
    if (!mend_.lean()) return false;
    engine_.respond(residual, now_.d_star);
    mend_.stand_up();
    return true;
  }

  /// Is a share of the step's load that is still left no more than the error of an event's load?
  /// Unloading to nothing opens the last pairs exactly at full load; computed, that may come a
  /// rounding too early, with about eps / rcond of the load still to go, and the listing's mark for
  /// "no event" then takes every quiet pair along. A path that is mended asks this only where the
  /// last pairs that hold the structure would open.
  [[nodiscard]] bool falls_at_full_load(double share_left) {
    constexpr double never_less = 1e-9;
    constexpr double never_more = 1e-6;
    if (share_left > never_more || (mend_.on() && now_.held())) return false;
    if (share_left <= never_less) return true;
    return share_left <= std::numeric_limits<double>::epsilon() / engine_.reciprocal_condition();
  }

  /// Take the kernel's toggles back and apply the whole rest: an event exactly at full load is left
  /// undone, as the listing itself leaves one whose s is 1.
  double leave_undone() {
    now_.take_back_toggles();
    return 1.0;
  }

  void switch_springs() {
    for (const event& e : now_.events) engine_.switch_spring(e.pair, e.what == change::make);
    if (std::vector<int> pairs = now_.opened(); !pairs.empty()) last_opened_ = std::move(pairs);
    now_.sprung = now_.status;
  }

  /// The load is applied: put D where the springs' own law has it, and let the kernel mend what
  /// rounding left behind on the way: the response is then to what is out of balance.
  void settle(int step, int number) {
    const residual_load nothing{increment_, 0.0};
    const int rounds = 20 + 4 * static_cast<int>(now_.pairs());
    for (int round = 0; round < rounds; ++round) {
      const std::vector<double> u = displacement(nothing);
      if (mend_.obeys(u)) return put_at(u);
      mend_.put_on_faces();
      for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d_star[i] = u[now_.at_dof[i]] - now_.d[i];
      const double s_min = now_.ask(leader_, mend_.d_test(), observers_);
      if (now_.events.empty() || !now_.held()) {  // nothing to mend, or only rounding opens the last
        now_.take_back_toggles();
        return put_at(u);
      }
      now_.advance(s_min, !mend_.on());
      tell_increment(step, ++number, s_min, false);
      switch_springs();
    }
  }

  void put_at(std::span<const double> u) {
    for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d[i] = u[now_.at_dof[i]];
  }

  /// The displacement of every dof now, under the load applied so far.
  std::vector<double> displacement(const residual_load& residual) {
    std::vector<double> applied(total_.size());
    for (std::size_t i = 0; i < applied.size(); ++i) applied[i] = total_[i] - residual.share * increment_[i];
    std::vector<double> u(applied.size());
    mend_.lean();
    mend_.hold_at_rest(applied);
    engine_.recover(applied, mend_.on() ? now_.forces_by_law() : now_.forces_gathered(), u);
    mend_.stand_up();
    return u;
  }

  void tell_increment(int step, int number, double s_min, bool snaps) {
    for (observer* o : observers_) o->incremented({step, number, s_min, fraction_, now_.events, snaps});
  }

  void tell_end(int step, double fraction, std::span<const double> u, bool from_elsewhere) {
    mend_.lean();
    const double rcond = engine_.reciprocal_condition();
    mend_.stand_up();
    for (observer* o : observers_) o->step_ended({step, fraction, u, now_.status, rcond, from_elsewhere});
  }

  /// Nothing stops the structure: the state reached is the one in which the pairs that opened last
  /// were about to, and their springs, at rest, still hold it.
  path_end set_free(int step, const residual_load& residual) {
    for (const int pair : last_opened_) {
      if (std::exchange(now_.status[static_cast<std::size_t>(pair)], in_contact) == in_contact) continue;
      engine_.switch_spring(pair, true);
    }
    now_.sprung = now_.status;
    if (!now_.held() && (!has_moved() || !can_lean())) return never_held(step);
    return stop(path_status::mechanism, step, residual, last_opened_);
  }

  [[nodiscard]] bool has_moved() const {
    return std::any_of(now_.d.begin(), now_.d.end(), [](double d) { return d != 0.0; });
  }

  [[nodiscard]] bool can_lean() {
    const bool can = mend_.lean();
    mend_.stand_up();
    return can;
  }

  /// Nothing holds the structure from the start: it has not moved, and nothing can be solved.
  path_end never_held(int step) {
    if (from_fallback(step)) return {path_status::solved, step, 1.0, {}};
    const std::vector<double> u(total_.size());
    for (observer* o : observers_) o->step_ended({step, 0.0, u, now_.status, 0.0});
    return {path_status::mechanism, step, 0.0, {}};
  }

  /// Tell the state reached, and end.
  path_end stop(path_status status, int step, const residual_load& residual, std::vector<int> pairs) {
    const double fraction = 1.0 - residual.share;
    if (status != path_status::solved && from_fallback(step)) return {path_status::solved, step, 1.0, {}};
    if (status == path_status::not_factored) return {status, step, fraction, {}};
    const std::vector<double> u = displacement(residual);
    if (!std::all_of(u.begin(), u.end(), [](double x) { return std::isfinite(x); })) {
      return {path_status::not_factored, step, fraction, {}};
    }
    tell_end(step, fraction, u, false);
    return {status, step, fraction, std::move(pairs)};
  }

  path_state now_;
  stiffness_engine& engine_;
  kernel& leader_;
  std::span<observer* const> observers_;
  int increments_allowed_;
  const fallback_solver& rescue_;
  mending mend_;

  std::vector<double> total_;      // total load at the end of the step [dofs]
  std::vector<double> increment_;  // total less the previous step's [dofs]
  std::uint64_t version_ = 0;      // of the increment
  double fraction_ = 0.0;          // share of the step's load applied by now
  std::vector<int> last_opened_;   // by the last increment that opened any
  cycle_detector cycles_;
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
  path p(s, engine, leader, observers, increments_allowed(limits, s.pairs.size()), limits.fallback);
  path_end end;
  for (int step = 1; step <= steps && end.status == path_status::solved; ++step) {
    try {
      end = p.follow_step(step, total_load);
    } catch (const no_factor&) {
      end = {p.from_fallback(step) ? path_status::solved : path_status::not_factored, step, p.fraction(), {}};
    }
  }
  end.work = engine.counts();
  return end;
}

}  // namespace contct
