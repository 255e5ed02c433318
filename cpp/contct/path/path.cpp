#include "contct/path/path.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "contct/path/path_state.hpp"
#include "contct/path/policy.hpp"

namespace contct::path {
namespace {

/// The loop, and how it ends.
class path {
 public:
  path(const linear_structure& s, stiffness_engine& engine, kernel& leader,
       std::span<observer* const> observers, const path_limits& limits)
      : increments_allowed_(increments_allowed(limits, s.pairs.size())),
        by_1989_rule_(leader.facts().rule == contact_rule::listing),
        now_(s, engine, observers, by_1989_rule_),
        cycles_(s.pairs.size()),
        limits_(limits),
        policy_(make_policy(now_, leader, cycles_, limits_)) {
    if (!by_1989_rule_) now_.refine = limits.refine;
  }

  /// The paper's loop, for one load step.
  path_end follow_step(int step, const load_history& total_load) {
    begin_step(step, total_load);  // R* = the step's total load less the previous one's
    if (motions_are_doubtful_)
      if (const std::optional<path_end> end = without_rounding()) return *end;
    for (int number = 1; number <= increments_allowed_; ++number) {
      try {
        if (const std::optional<path_end> end = follow_increment(step, number)) return *end;
      } catch (const no_factor&) {
        if (const std::optional<path_end> end = without_rounding()) return *end;
        if (!policy_->go_on_ahead(number)) throw;
      }
    }
    return stop(path_status::iteration_limit, step, cycles_.restless_pairs());
  }

  /// The stiffness has no factor.
  path_end not_factored(int step) {
    if (const std::optional<path_end> end = by_other_means()) return *end;
    return {truly(path_status::not_factored), step, now_.fraction(), {}};
  }

  /// Has the full load of this step an equilibrium? Of beams and plates decided by the rigid-body motions,
  /// otherwise by the exact path, or shown by the reference solution.
  [[nodiscard]] std::optional<bool> has_equilibrium() const {
    if (const std::optional<bool> known = now_.has_equilibrium()) return known;
    const std::optional<followed_step> exactly = limits_.exactly ? limits_.exactly(now_.step) : std::nullopt;
    if (exactly) return exactly->status == path_status::solved;
    if (limits_.fallback && limits_.fallback(now_.step, 1.0, now_.total)) return true;
    return std::nullopt;
  }

  [[nodiscard]] bool by_1989_rule() const { return by_1989_rule_; }

 private:
  /// One increment. An end where it is the last, or the path cannot go on; going on ahead counts as one more.
  std::optional<path_end> follow_increment(int step, int& number) {
    const response w_star = policy_->respond();  // K w* = R*, with the springs of the pairs now in contact
    double s_min = 0.0;
    if (w_star != response::none) s_min = policy_->ask();  // the kernel gives s_min and toggles statuses
    if (w_star == response::none || !policy_->accept(s_min)) {
      if (std::optional<path_end> end = without_rounding()) return end;
      if (policy_->go_on_ahead(number)) return std::nullopt;
      return set_free(step);
    }
    const bool moved = now_.advance(s_min);                               // D <- D + s_min d*
    if (w_star == response::elastic) now_.residual.share *= 1.0 - s_min;  // R* <- (1 - s_min) R*
    now_.tell_increment(number, s_min, w_star == response::rigid);
    if (!policy_->goes_on()) return stop(path_status::mechanism, step, now_.opened());
    now_.switch_springs();  // of the pairs that the kernel toggled
    if (s_min == 1.0) return end_step(step, number);
    if (!cycles_.repeats(moved, now_.status, now_.events)) return std::nullopt;
    if (std::optional<path_end> end = without_rounding()) return end;
    if (!policy_->go_on_ahead(++number)) return stop(path_status::cycle, step, cycles_.restless_pairs());
    cycles_.reset();
    return std::nullopt;
  }

  void begin_step(int step, const load_history& total_load) {
    now_.begin_step(step, total_load);
    cycles_.reset();
    policy_->begin_step();
  }

  path_end end_step(int step, int number) {
    policy_->end_step(number);
    return stop(path_status::solved, step, {});
  }

  /// Nothing stops the structure. The state reached is the one in which the pairs that opened last were about
  /// to: without force, their springs still hold it.
  path_end set_free(int step) {
    for (const int pair : now_.last_opened) now_.status[pair] = in_contact;
    now_.adopt_statuses();
    const bool has_moved = std::any_of(now_.d.begin(), now_.d.end(), [](double d) { return d != 0.0; });
    if (!now_.held() && (!has_moved || !policy_->can_be_held())) return never_held(step);
    return stop(path_status::mechanism, step, now_.last_opened);
  }

  /// Nothing holds the structure, and all pairs together would not: it has only moved as a rigid body.
  path_end never_held(int step) {
    if (const std::optional<path_end> end = by_other_means()) return *end;
    const std::vector<double> u = now_.shape;
    now_.tell_end({step, now_.fraction(), u, now_.status, 0.0});
    return {truly(path_status::mechanism), step, now_.fraction(), {}};
  }

  /// How a path ends that seems to end so: in a mechanism only where there is certainly no equilibrium.
  /// Where there is one, a structure that all pairs together hold was lost for want of digits, but to the
  /// 1989 rule, which does not follow rigid-body motions.
  [[nodiscard]] path_status truly(path_status seems) const {
    const std::optional<bool> at_once = policy_->can_stand();
    if (at_once == false) return path_status::mechanism;
    if (seems != path_status::mechanism) return seems;
    const std::optional<bool> exists = has_equilibrium();
    if (exists == false) return path_status::mechanism;
    const linear_structure& s = now_.structure;
    const bool all_hold = s.is_held(s.held_by([](std::size_t) { return true; }));
    return at_once == true && all_hold ? path_status::not_factored : path_status::path_ended;
  }

  /// What is left of the step where rounding may be what ended it: where there is an equilibrium at its end,
  /// or only rounding would decide that.
  std::optional<path_end> without_rounding() {
    if (policy_->can_stand() == false) return std::nullopt;
    std::optional<path_end> end = policy_->follow_exactly();
    motions_are_doubtful_ = end && !now_.structure.truth && now_.structure.rigid_motions > 0;
    return end;
  }

  /// The end of a step that the path does not reach: without rounding, or at the reference solution.
  std::optional<path_end> by_other_means() {
    if (std::optional<path_end> end = without_rounding()) return end;
    if (policy_->fall_back(now_.step)) return path_end{path_status::solved, now_.step, 1.0, {}};
    return std::nullopt;
  }

  /// Tell the state reached, and end.
  path_end stop(path_status status, int step, std::vector<int> pairs) {
    const path_status seemed = std::exchange(status, truly(status));
    if (status != seemed && seemed != path_status::mechanism) pairs = now_.last_opened;
    if (status != path_status::solved)
      if (const std::optional<path_end> end = by_other_means()) return *end;
    std::vector<double> u(now_.total.size());
    policy_->displace(u);
    if (!std::all_of(u.begin(), u.end(), [](double x) { return std::isfinite(x); }))
      return {path_status::not_factored, step, now_.fraction(), {}};
    now_.tell_end({step, now_.fraction(), u, now_.status, policy_->reciprocal_condition()});
    return {status, step, now_.fraction(), std::move(pairs)};
  }

  int increments_allowed_;
  bool by_1989_rule_;
  /// A matrix whose rigid-body motions were counted from rounded numbers, on a path that doubles lost before:
  /// motions that are merely soft may be among them.
  bool motions_are_doubtful_ = false;
  path_state now_;
  cycle_detector cycles_;
  path_limits limits_;
  std::unique_ptr<path_policy> policy_;
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
  path p(s, engine, leader, observers, limits);
  path_end end;
  for (int step = 1; step <= steps && end.status == path_status::solved; ++step) {
    try {
      end = p.follow_step(step, total_load);
    } catch (const no_factor&) {
      end = p.not_factored(step);
    }
  }
  if (end.status != path_status::solved && end.status != path_status::not_factored)
    end.has_equilibrium = p.has_equilibrium();
  end.by_1989_rule = p.by_1989_rule();
  end.work = engine.counts();
  return end;
}

}  // namespace contct::path
