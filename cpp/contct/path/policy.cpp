#include "contct/path/policy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace contct::path {
namespace {

/// The 1989 driver: it solves, and takes the kernel's word, except for events within rounding of full load.
class policy_1989 final : public path_policy {
 public:
  using path_policy::path_policy;

  response respond() override {
    if (!now_.held()) return response::none;
    now_.engine.respond(now_.residual, now_.d_star);
    return response::elastic;
  }

  bool accept(double& s_min) override {
    if (s_min < 1.0 && reaches_full_load(s_min)) leave_undone(s_min);
    return true;
  }

  [[nodiscard]] bool goes_on() const override { return now_.held(); }

  void displace(std::span<double> u) override {
    now_.engine.recover(now_.applied_load(), now_.spring_forces(), u);
  }
};

/// A structure that nothing holds moves rigidly, at constant load, to the next face. Write to d* a rigid
/// motion that the residual load drives and that supports and closed pairs leave free: the limit, up to its
/// size, of the response of the structure on a ground that gets ever softer. It is long enough to reach every
/// separated pair on its way; `everywhere` [dofs] becomes all of it. False, and nothing written, when the
/// load does no work on any free motion.
bool rigid_snap(path_state& now, std::vector<double>& everywhere) {
  const std::optional<free_motion> motion = now.driven_motion();
  if (!motion) return false;
  double longest_way = 0.0;
  for (std::size_t i = 0; i < now.pairs(); ++i) {
    now.d_star[i] = 0.0;
    if (now.status[i] == in_contact) continue;
    now.d_star[i] = motion->at(static_cast<int>(now.at_dof[i]), now.structure.held_by_pairs[i]);
    if (now.d_star[i] != 0.0) longest_way = std::max(longest_way, (now.c[i] - now.d[i]) / now.d_star[i]);
  }
  const double longest = longest_way > 0.0 ? 2.0 * longest_way : 1.0;
  for (double& moves : now.d_star) moves *= longest;
  everywhere.assign(now.total.size(), 0.0);
  for (std::size_t dof = 0; dof < everywhere.size(); ++dof)
    if (now.structure.fixed[dof] == 0)
      everywhere[dof] = longest * motion->at(static_cast<int>(dof), now.structure.rigid_rows[dof]);
  return true;
}

/// The policy of the corrected rule: what no kernel can decide from one call (reference/corrected-rule.md).
///
/// Rigid motions that the load drives are followed to the next face at constant load; those that it does not
/// drive are held by springs without force. A pair that toggles twice running without progress stays in
/// contact until the load advances. At the end of a step D is computed from the springs' own law, and what
/// rounding left out of balance is put to the kernel once more. A path that cannot go on ends by `fallback`.
class stabilized_policy final : public path_policy {
 public:
  stabilized_policy(path_state& now, kernel& leader, cycle_detector& cycles, const path_limits& limits)
      : path_policy(now, leader), cycles_(cycles), fallback_(limits.fallback), exactly_(limits.exactly) {}

  void begin_step() override {
    kept_in_contact_.clear();
    last_toggled_at_rest_ = -1;
  }

  /// A billionth of the load further, the reference solution knows which pairs are in contact; or four times
  /// as far, and so on, to a millionth. Where the path is no further than the last such leap, the next one is
  /// longer.
  bool go_on_ahead(int number) override {
    constexpr int most_a_step = 16;
    if (leapt_in_ != now_.step) times_leapt_ = 0;
    if (leapt_in_ != now_.step || now_.residual.share < leapt_to_ - leap_) leap_ = shortest_leap / 4;
    leapt_in_ = now_.step;
    remove_holding_springs();
    while (fallback_ && leap_ < longest_leap && ++times_leapt_ <= most_a_step) {
      leap_ *= 4;
      if (leap(number, std::min(leap_, now_.residual.share / 2))) return true;
    }
    return false;
  }

  /// Three pairs of a plate may be in line but for the sixteenth digit: held, and without a factor.
  response respond() override {
    try {
      return respond_as_held();
    } catch (const no_factor&) {
      if (std::exchange(now_.held_in_doubles, true)) throw;
      return respond_as_held();
    }
  }

  double ask() override {
    const double s_min = now_.ask(leader_, d_test(), at_rest_);
    at_rest_ = s_min == 0.0 ? at_rest_ + 1 : 0;
    return s_min;
  }

  bool accept(double& s_min) override {
    if (rigid_ && s_min == 1.0) return false;
    // Only the last pairs that hold the structure open too early; any other event is followed.
    if (s_min < 1.0 && !now_.held() && opens_at_full_load(s_min)) leave_undone(s_min);
    if (keep_in_contact_if_toggled_again(s_min)) cycles_.reset();
    if (rigid_) now_.move_shape(s_min, motion_);
    return true;
  }

  [[nodiscard]] bool goes_on() const override { return true; }

  void end_step(int number) override {
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

  [[nodiscard]] std::optional<bool> can_stand() const override { return now_.has_equilibrium(); }

  void displace(std::span<double> u) override {
    std::vector<double> load = now_.applied_load();
    add_holding_springs();
    for (const int pair : holding_)  // no force where the pair is
      load[now_.at_dof[pair]] += now_.structure.pairs[pair].stiffness * now_.d[pair];
    now_.engine.recover(load, now_.spring_forces(), u);
    remove_holding_springs();
  }

  [[nodiscard]] double reciprocal_condition() override {
    add_holding_springs();
    double rcond = 0.0;
    try {
      rcond = now_.engine.reciprocal_condition();
    } catch (const no_factor&) {  // the state is known all the same: the fallback found it
    }
    remove_holding_springs();
    return rcond;
  }

  [[nodiscard]] bool can_be_held() override {
    const bool can = add_holding_springs();
    remove_holding_springs();
    return can;
  }

  std::optional<path_end> follow_exactly() override {
    const std::optional<followed_step> found = exactly_ ? exactly_(now_.step) : std::nullopt;
    if (!found) return std::nullopt;
    remove_holding_springs();
    tell_rest(*found);
    for (std::size_t i = 0; i < now_.pairs(); ++i)
      now_.status[i] = found->closed[i] != 0 ? in_contact : separated;
    const bool freed = found->status == path_status::mechanism;
    if (freed)  // the state reached is the one in which the pairs that opened last were about to
      for (const int pair : now_.last_opened) now_.status[pair] = in_contact;
    now_.adopt_statuses();
    put_pairs_at(found->displacement);
    std::vector<double> u = found->displacement;
    now_.tell_end(step_state{.step = now_.step,
                             .fraction = found->fraction,
                             .displacement = u,
                             .isep = now_.status,
                             .rcond = reciprocal_condition(),
                             .from_fallback = false,
                             .from_reference = false,
                             .from_exact_path = true});
    return path_end{found->status, now_.step, found->fraction, freed ? now_.last_opened : std::vector<int>()};
  }

  bool fall_back(int step) override {
    if (!fallback_) return false;
    const std::optional<equilibrium_state> found = fallback_(step, 1.0, now_.total);
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

 private:
  response respond_as_held() {
    rigid_ = !now_.held() && rigid_snap(now_, motion_);
    if (rigid_) return response::rigid;
    if (!add_holding_springs()) return response::none;
    now_.engine.respond(now_.residual, now_.d_star);
    remove_holding_springs();
    return response::elastic;
  }

  /// Tell the increments of an exact step behind the share that the path has reached. Where its pairs are not
  /// those that are in contact there, they become so first.
  void tell_rest(const followed_step& exactly) {
    const std::vector<followed_increment>& all = exactly.increments;
    std::vector<char> closed = exactly.closed;
    for (std::size_t i = all.size(); i-- > 0;)
      for (const event& e : all[i].events) closed[e.pair] = e.what == change::make ? 0 : 1;
    double reached = now_.fraction();
    std::size_t next = told_of(all, closed, reached);
    for (std::size_t i = 0; i < next; ++i) toggle(all[i].events, closed);
    now_.take_over(closed);
    if (!now_.events.empty() && next > 0 && next < all.size()) {
      const followed_increment& from = all[next - 1];
      const followed_increment& to = all[next];
      const double way = (reached - from.fraction) / (to.fraction - from.fraction);
      for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d[i] = from.d[i] + way * (to.d[i] - from.d[i]);
      tell_exact_increment(0.0, false);
    }
    for (; next < all.size(); ++next) {
      const followed_increment& i = all[next];
      toggle(i.events, closed);
      now_.take_over(closed);
      now_.d = i.d;
      const double s = i.snaps || reached == 1.0 ? 0.0 : (i.fraction - reached) / (1.0 - reached);
      now_.residual.share = 1.0 - i.fraction;
      reached = i.fraction;
      tell_exact_increment(s, i.snaps);
    }
  }

  /// How many increments of an exact step the path has told: all before the share `reached`, and of those at
  /// it as many as it takes to come to the path's pairs in contact from `closed`, those at the step's start.
  [[nodiscard]] std::size_t told_of(std::span<const followed_increment> all, std::vector<char> closed,
                                    double reached) const {
    constexpr double rounding = 1e-12;
    const auto agree = [](char is_closed, int isep) { return (is_closed != 0) == (isep == in_contact); };
    std::size_t told = 0;
    for (std::size_t i = 0; i < all.size() && all[i].fraction <= reached + rounding; ++i) {
      toggle(all[i].events, closed);
      const bool ends = all[i].fraction == 1.0 && all[i].events.empty();
      if (all[i].fraction < reached ||
          (!ends && std::equal(closed.begin(), closed.end(), now_.sprung.begin(), agree)))
        told = i + 1;
    }
    return told;
  }

  void tell_exact_increment(double s, bool snaps) {
    now_.tell_increment(now_.increments + 1, s, snaps, now_.d);
    now_.switch_springs();
  }

  static void toggle(std::span<const event> events, std::vector<char>& closed) {
    for (const event& e : events) closed[e.pair] = e.what == change::make ? 1 : 0;
  }

  /// Go on from the reference solution where `distance` more of the step's load is applied. False, and
  /// nothing changed, when it has none.
  bool leap(int number, double distance) {
    const double share = now_.residual.share;
    now_.residual.share = share - distance;
    const std::optional<equilibrium_state> found =
        now_.residual.share < share ? fallback_(now_.step, now_.fraction(), now_.applied_load())
                                    : std::nullopt;
    if (!found) {
      now_.residual.share = share;
      return false;
    }
    leapt_to_ = now_.residual.share;
    now_.take_over(found->closed);
    put_pairs_at(found->displacement);
    now_.shape = found->displacement;
    begin_step();
    now_.tell_increment(number, distance / share, false, now_.d);
    now_.switch_springs();
    return true;
  }

  /// Do the last pairs that hold the structure open exactly at full load, but for rounding? The load of the
  /// step then does no work on the motions that they free.
  [[nodiscard]] bool opens_at_full_load(double s_min) const {
    constexpr double rounding_at_most = 1e-6;
    const std::optional<bool> driven = now_.total_drives_a_motion();
    if (!driven) return reaches_full_load(s_min);
    return !*driven && now_.residual.share * (1.0 - s_min) <= rounding_at_most;
  }

  /// Where supports and pairs in contact leave rigid motions free that the load does not drive, springs of
  /// separated pairs hold the structure for a solve, each at rest where its pair is. False when even these do
  /// not hold it.
  bool add_holding_springs() {
    remove_holding_springs();
    rigid_rank rank = now_.held_by();
    std::vector<int> holding = now_.structure.pairs_that_hold(rank);
    if (!now_.structure.is_held(rank)) return false;
    holding_ = std::move(holding);
    for (const int pair : holding_) now_.engine.switch_spring(pair, true);
    return true;
  }

  void remove_holding_springs() {
    for (const int pair : holding_) now_.engine.switch_spring(pair, false);
    holding_.clear();
  }

  /// In exact arithmetic d* keeps its sign when its pair is toggled at its face, d' = d / (1 + k F): a pair
  /// toggled twice running without progress has a d* of rounding.
  bool keep_in_contact_if_toggled_again(double s_min) {
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
  [[nodiscard]] std::span<const double> d_test() {
    if (kept_in_contact_.empty()) return now_.d_star;
    d_test_ = now_.d_star;
    for (const int pair : kept_in_contact_) d_test_[now_.first_there[pair]] = 0.0;
    for (std::size_t i = 0; i < d_test_.size(); ++i) d_test_[i] = d_test_[now_.first_there[i]];
    return d_test_;
  }

  /// Is every pair on the side of its face that its status says? A separated one may be beyond it by rounding
  /// of the largest deflection, one in contact off it by rounding of the face.
  [[nodiscard]] bool statuses_agree_with(std::span<const double> u) const {
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

  void put_overshot_pairs_on_their_faces() {
    for (std::size_t i = 0; i < now_.pairs(); ++i) {
      double& at = now_.d[now_.first_there[i]];
      if (now_.status[i] * now_.surface[i] * (now_.c[i] - at) < 0) at = now_.c[i];
    }
    for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d[i] = now_.d[now_.first_there[i]];
  }

  void put_pairs_at(std::span<const double> u) {
    for (std::size_t i = 0; i < now_.pairs(); ++i) now_.d[i] = u[now_.at_dof[i]];
  }

  static constexpr double shortest_leap = 0x1p-30;
  static constexpr double longest_leap = 0x1p-20;

  cycle_detector& cycles_;
  const fallback_solver& fallback_;
  const exact_follower& exactly_;
  bool rigid_ = false;                // the last response
  std::vector<double> motion_;        // that response, where it is rigid [dofs]
  int at_rest_ = 0;                   // answers in a row with SMIN = 0
  int last_toggled_at_rest_ = -1;     // the pair that the last answer without progress toggled
  int leapt_in_ = 0;                  // the last step in which the path went on ahead
  int times_leapt_ = 0;               // how often it tried to there
  double leap_ = 0.0;                 // how far it tried last, in shares of the step's load
  double leapt_to_ = 0.0;             // the share of the load that was left then
  std::vector<int> kept_in_contact_;  // pairs that are not asked until the load advances
  std::vector<int> holding_;          // separated pairs whose springs hold the structure for a solve
  std::vector<double> d_test_;        // d* with 0 for the pairs kept in contact [pairs]
};

}  // namespace

std::unique_ptr<path_policy> make_policy(path_state& now, kernel& leader, cycle_detector& cycles,
                                         const path_limits& limits) {
  if (leader.facts().rule == contact_rule::listing) return std::make_unique<policy_1989>(now, leader);
  return std::make_unique<stabilized_policy>(now, leader, cycles, limits);
}

}  // namespace contct::path
