#include "contct/path/path.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "contct/path/path_state.hpp"
#include "contct/path/policy.hpp"

namespace contct {
namespace {

class path {
 public:
  path(const linear_structure& s, stiffness_engine& engine, kernel& leader,
       std::span<observer* const> observers, const path_limits& limits)
      : increments_allowed_(increments_allowed(limits, s.pairs.size())),
        by_1989_rule_(leader.facts().rule == contact_rule::listing),
        now_(s, engine, observers, by_1989_rule_),
        ends_(limits.ends),
        policy_(make_policy(now_, leader)) {}

  path_end follow_step(int step, const load_history& total_load) {
    path_end end;
    std::optional<reached_state> state;
    reported_.reset();
    try {
      end = loop(step, total_load);
      state = reached();
    } catch (const no_factor&) {
      end = ended(path_status::not_factored);
    }
    return finish(std::move(end), state);
  }

 private:
  /// The paper's loop.
  path_end loop(int step, const load_history& total_load) {
    now_.begin_step(step, total_load);  // R* = the step's total load minus the previous total load
    policy_->begin_step();
    for (int number = 1; number <= increments_allowed_; ++number) {
      const response w_star = policy_->respond();  // K w* = R*, with the springs of the pairs now in contact
      if (w_star == response::none) return set_free();
      const std::optional<double> s_min = policy_->decide();  // the kernel returns s_min and toggles statuses
      if (!s_min) return set_free();
      const bool moved = now_.advance(*s_min);                               // D <- D + s_min d*
      if (w_star == response::elastic) now_.residual.share *= 1.0 - *s_min;  // R* <- (1 - s_min) R*
      now_.tell_increment(number, *s_min, w_star == response::rigid);
      if (!policy_->goes_on()) return ended(path_status::mechanism, now_.opened());
      now_.switch_springs();  // the springs of the pairs in now_.events
      if (*s_min == 1.0) return ended(path_status::solved);
      if (now_.cycles.repeats(moved, now_.status, now_.events))
        return ended(path_status::cycle, now_.cycles.restless_pairs());
    }
    return ended(path_status::iteration_limit, now_.cycles.restless_pairs());
  }

  [[nodiscard]] path_end ended(path_status status, std::vector<int> pairs = {}) const {
    return {status, now_.step, now_.fraction(), std::move(pairs)};
  }

  /// Ends the path in a mechanism. Puts the pairs of the last separation back in contact, so that their
  /// springs hold the structure without force; they are reported as separated.
  path_end set_free() {
    reported_ = now_.status;
    for (const int pair : now_.last_opened) now_.status[pair] = in_contact;
    now_.find_events();
    now_.switch_springs();
    return ended(path_status::mechanism, now_.last_opened);
  }

  struct reached_state {
    std::vector<double> u;  // [dofs]
    double rcond;
  };

  /// The state under the load applied so far. If the structure cannot be held, returns the
  /// displacements after the rigid-body motions. Returns nothing if the state is out of range in double
  /// precision.
  [[nodiscard]] std::optional<reached_state> reached() {
    reached_state r{std::vector<double>(now_.total.size()), 0.0};
    const bool is_held = policy_->displace(r.u);
    if (!is_held) r.u = now_.shape;
    if (is_held && !std::ranges::all_of(r.u, [](double x) { return std::isfinite(x); })) return std::nullopt;
    if (is_held) r.rcond = policy_->reciprocal_condition();
    now_.to_displacement(r.u);
    return r;
  }

  /// Ends a step. Under the 1989 rule, the state is reported unchanged. Under other rules, the state is
  /// proved; if the proof or the path fails, a state that is found without the path replaces it.
  path_end finish(path_end end, const std::optional<reached_state>& reached) {
    if (!by_1989_rule_ || end.status != path_status::solved) end.has_equilibrium = now_.has_equilibrium();
    if (ends_ && !by_1989_rule_ && end.has_equilibrium != false) {
      const bool is_whole = reached && end.status == path_status::solved;
      const full_load_state state{is_whole ? reached->u : std::vector<double>(), now_.status};
      const found_end found = ends_(end.step, is_whole ? &state : nullptr);
      if (found.state) return arrive_at(*found.state, reached);
      if (found.exists) end.has_equilibrium = found.exists;
    } else if (ends_ && !end.has_equilibrium && end.status != path_status::solved) {
      end.has_equilibrium = ends_(end.step, nullptr).exists;
    }
    if (reached)
      now_.tell_end({end.step, end.fraction, reached->u, reported_.value_or(now_.status), reached->rcond});
    else
      end = {path_status::not_factored, end.step, end.fraction, {}, {}, end.has_equilibrium};
    return concluded(std::move(end));
  }

  /// Continues the path from `found`. If the path reached this state itself, the path keeps its own
  /// displacements.
  path_end arrive_at(const full_load_state& found, const std::optional<reached_state>& reached) {
    const bool is_own = reached && !found.from_reference && !found.from_exact_path;
    const bool has_rcond = is_own && found.isep == now_.status;
    now_.put_at(is_own ? reached->u : found.displacement, found.isep);
    now_.tell_end({.step = now_.step,
                   .fraction = 1.0,
                   .displacement = found.displacement,
                   .isep = found.isep,
                   .rcond = has_rcond ? reached->rcond : policy_->reciprocal_condition(),
                   .from_fallback = !is_own,
                   .from_reference = found.from_reference,
                   .from_exact_path = found.from_exact_path,
                   .numbers = found.numbers ? &*found.numbers : nullptr});
    return {path_status::solved, now_.step};
  }

  /// Sets the final status. A path that failed ends in a mechanism only if certainly no equilibrium exists.
  [[nodiscard]] path_end concluded(path_end end) const {
    const bool is_mechanism = end.has_equilibrium == false;
    if (end.status == path_status::mechanism) {
      if (!is_mechanism) end.status = path_status::path_ended;
    } else if (is_mechanism && !by_1989_rule_) {
      end.status = path_status::mechanism;
      end.pairs = now_.last_opened;
    }
    if (end.status == path_status::solved || end.status == path_status::not_factored)
      end.has_equilibrium.reset();
    return end;
  }

  int increments_allowed_;
  bool by_1989_rule_;
  path_state now_;
  std::optional<std::vector<int>> reported_;  // statuses after the last increment, if set_free changed them
  end_finder ends_;
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
  bool stands = true;  // the previous step was solved
  for (int step = 1; step <= steps; ++step) {
    if (!stands && !total_load.from_zero(step)) continue;
    path_end of_step = p.follow_step(step, total_load);
    stands = of_step.status == path_status::solved;
    end.take(std::move(of_step));
  }
  end.by_1989_rule = leader.facts().rule == contact_rule::listing;
  for (path_end& other : end.others) other.by_1989_rule = end.by_1989_rule;
  end.work = engine.counts();
  return end;
}

}  // namespace contct
