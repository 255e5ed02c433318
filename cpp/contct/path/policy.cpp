#include "contct/path/policy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contct/linear/factored_stiffness.hpp"

namespace contct {

response path_policy::respond() {
  if (!now_.held()) return response::none;
  now_.engine.respond(now_.residual, now_.d_star);
  return response::elastic;
}

std::optional<double> path_policy::decide() {
  const double s_min = now_.ask(leader_, now_.d_star);
  return s_min < 1.0 && reaches_full_load(s_min) ? leave_undone() : s_min;
}

/// Uses `sprung`, the statuses in the stiffness, because the last events may not have switched springs yet.
bool path_policy::displace(std::span<double> u) {
  if (!now_.structure.is_held(now_.held_by(now_.sprung))) return false;
  now_.engine.recover(now_.applied_load(), now_.spring_forces(), u);
  return true;
}

bool path_policy::reaches_full_load(double s_min) const {
  constexpr double never_less = 1e-9;
  constexpr double never_more = 1e-6;
  const double share_left = now_.residual.share * (1.0 - s_min);
  if (share_left > never_more) return false;
  if (share_left <= never_less) return true;
  return share_left <= std::numeric_limits<double>::epsilon() / now_.engine.reciprocal_condition();
}

namespace {

/// Returns a - b, or 0 if the difference is only rounding, because two dofs of one rigid body can move
/// equally.
double difference(double a, double b, double rounding) {
  const double largest = std::max(std::abs(a), std::abs(b));
  return std::abs(a - b) <= std::max(1e-10, rounding) * largest ? 0.0 : a - b;
}

/// Writes a rigid-body motion to d*, and at all dofs to `everywhere` [dofs]. By this motion, a structure that
/// nothing holds moves to the next face at constant load. Supports and pairs in contact leave the motion
/// free, and the residual load drives it. The direction of the motion is the limit of the response on an ever
/// softer ground; its length is twice the longest way of a separated pair to its face. Returns false, and
/// writes nothing, if the load does no work on any such motion.
bool rigid_snap(path_state& now, std::vector<double>& everywhere) {
  const std::optional<free_motion> motion = now.driven_motion();
  if (!motion) return false;
  double longest_way = 0.0;
  for (std::size_t i = 0; i < now.pairs(); ++i) {
    now.d_star[i] = 0.0;
    if (now.status[i] == in_contact) continue;
    now.d_star[i] = motion->at(static_cast<int>(now.at_dof[i]));
    if (const int other = now.structure.pairs[i].other; other >= 0)
      now.d_star[i] = difference(now.d_star[i], motion->at(other), now.structure.rigid_rounding);
    if (now.d_star[i] != 0.0) longest_way = std::max(longest_way, (now.c[i] - now.d[i]) / now.d_star[i]);
  }
  const double longest = longest_way > 0.0 ? 2.0 * longest_way : 1.0;
  for (double& moves : now.d_star) moves *= longest;
  everywhere.assign(now.total.size(), 0.0);
  for (std::size_t dof = 0; dof < everywhere.size(); ++dof)
    if (now.structure.fixed[dof] == 0) everywhere[dof] = longest * motion->at(static_cast<int>(dof));
  return true;
}

/// Holds the structure for a solve: if supports and pairs in contact do not hold it, inserts springs of
/// separated pairs, without force. The destructor removes them.
class holding_springs {
 public:
  explicit holding_springs(path_state& now) : engine_(now.engine) {
    rigid_rank rank = now.held_by();
    std::vector<int> separated_pairs = now.structure.pairs_that_hold(rank);
    suffice = now.structure.is_held(rank);
    if (suffice) pairs = std::move(separated_pairs);
    for (const int pair : pairs) engine_.switch_spring(pair, true);
  }
  ~holding_springs() {
    for (const int pair : pairs) engine_.switch_spring(pair, false);
  }
  holding_springs(const holding_springs&) = delete;
  holding_springs& operator=(const holding_springs&) = delete;

  bool suffice = false;    ///< false: no springs are inserted
  std::vector<int> pairs;  ///< the pairs whose springs are inserted

 private:
  stiffness_engine& engine_;
};

/// The policy of the corrected rule (reference/corrected-rule.md), for decisions that need several calls.
///
/// A rigid-body motion that the load drives continues to the next face at constant load. Springs without
/// force stop the other rigid-body motions. A pair that toggles twice in succession without progress stays in
/// contact until the load advances. After many answers without progress, the pair of least index toggles.
class corrected_policy final : public path_policy {
 public:
  using path_policy::path_policy;

  void begin_step() override {
    kept_in_contact_.clear();
    last_toggled_at_rest_ = -1;
    answers_at_rest_ = 0;
  }

  response respond() override {
    rigid_ = !now_.held() && rigid_snap(now_, motion_);
    if (rigid_) return response::rigid;
    const holding_springs springs(now_);
    if (!springs.suffice) return response::none;
    now_.engine.respond(now_.residual, now_.d_star);
    return response::elastic;
  }

  std::optional<double> decide() override {
    double s_min = now_.ask(leader_, d_test());
    answers_at_rest_ = s_min == 0.0 ? answers_at_rest_ + 1 : 0;
    if (answers_at_rest_ > quick_answers_at_rest(now_.pairs()) && !now_.events.empty())
      toggle_first_at_rest();
    if (rigid_ && s_min == 1.0) return std::nullopt;
    // Only events that separate the last pairs that hold the structure are undone.
    if (s_min < 1.0 && !now_.held() && opens_at_full_load(s_min)) s_min = leave_undone();
    if (keep_in_contact_if_toggled_again(s_min)) now_.cycles.reset();
    if (rigid_) now_.move_shape(s_min, motion_);
    return s_min;
  }

  [[nodiscard]] bool goes_on() const override { return true; }

  bool displace(std::span<double> u) override {
    const holding_springs springs(now_);
    if (!springs.suffice) return false;
    std::vector<double> load = now_.applied_load();
    for (const int pair : springs.pairs)  // makes the spring's force 0 at the current D
      now_.structure.pairs[pair].add_to(load, now_.structure.pairs[pair].stiffness * now_.d[pair]);
    now_.engine.recover(load, now_.spring_forces(), u);
    return true;
  }

  [[nodiscard]] double reciprocal_condition() override {
    const holding_springs springs(now_);
    try {
      return now_.engine.reciprocal_condition();
    } catch (const no_factor&) {  // no error: the state was found without this stiffness
      return 0.0;
    }
  }

 private:
  /// Toggles the pair with the least index among the pairs at their faces. This choice never cycles (Murty
  /// 1974); the kernel's choice, the pair with the largest response, can cycle.
  void toggle_first_at_rest() {
    const auto first = std::ranges::find(now_.s, 0.0);
    if (first == now_.s.end()) return;
    now_.status = now_.sprung;
    now_.status[first - now_.s.begin()] *= -1;
    now_.find_events();
  }

  /// True if the last pairs that hold the structure separate at full load, up to rounding. The step's load
  /// then does no work on the motions that become free.
  [[nodiscard]] bool opens_at_full_load(double s_min) const {
    constexpr double rounding_at_most = 1e-6;
    const std::optional<bool> driven = now_.total_drives_a_motion();
    if (!driven) return reaches_full_load(s_min);
    return !*driven && now_.residual.share * (1.0 - s_min) <= rounding_at_most;
  }

  /// Keeps a pair in contact if it toggles twice in succession without progress; returns true in this case.
  /// In exact arithmetic, toggling a pair at its face does not change the sign of d*: d' = d / (1 + k F) with
  /// the flexibility F. The d* of such a pair is therefore rounding.
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
    now_.find_events();
    return true;
  }

  /// d* for the call of the kernel, with 0 for pairs that are kept in contact [pairs].
  [[nodiscard]] std::span<const double> d_test() {
    if (kept_in_contact_.empty()) return now_.d_star;
    d_test_ = now_.d_star;
    for (const int pair : kept_in_contact_)  // other pairs at the same dofs get 0 too
      for (std::size_t i = 0; i < d_test_.size(); ++i)
        if (now_.at_dof[i] == now_.at_dof[pair] &&
            now_.structure.pairs[i].other == now_.structure.pairs[pair].other)
          d_test_[i] = 0.0;
    return d_test_;
  }

  bool rigid_ = false;                // the last response is a rigid-body motion
  std::vector<double> motion_;        // the last rigid-body motion [dofs]
  int answers_at_rest_ = 0;           // number of successive answers with SMIN = 0
  int last_toggled_at_rest_ = -1;     // the pair that the last answer with SMIN = 0 toggled
  std::vector<int> kept_in_contact_;  // pairs that stay in contact until the load advances
  std::vector<double> d_test_;
};

}  // namespace

std::unique_ptr<path_policy> make_policy(path_state& now, kernel& leader) {
  if (leader.facts().rule == contact_rule::listing) return std::make_unique<path_policy>(now, leader);
  return std::make_unique<corrected_policy>(now, leader);
}

}  // namespace contct
