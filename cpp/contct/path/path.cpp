#include "contct/path/path.hpp"

#include <algorithm>
#include <cmath>

#include "contct/path/path_state.hpp"
#include "contct/path/policy.hpp"

namespace contct {

int increments_allowed(int asked, std::size_t pairs) {
  constexpr std::size_t most = most_increments;
  if (asked > 0) return std::min(asked, most_increments);
  return static_cast<int>(std::min(most, 1000 + 50 * std::min(most, pairs)));
}

path::path(const linear_structure& s, const load_history& loads, stiffness_engine& engine, kernel& leader,
           std::span<observer* const> observers, int max_increments)
    : increments_allowed_(increments_allowed(max_increments, s.pairs.size())),
      by_1989_rule_(leader.facts().rule == contact_rule::listing),
      now_(std::make_unique<path_state>(s, loads, engine, observers, by_1989_rule_)),
      policy_(make_policy(*now_, leader)) {}

path::~path() = default;

path_end path::follow(int step) {
  path_end end;
  reported_.reset();
  reached_.reset();
  try {
    now_->begin_step(step);  // R* = the step's total load minus the previous total load
    policy_->begin_step();
    end = loop();
    reach();
  } catch (const no_factor&) {
    end = ended(path_status::not_factored);
  }
  if (!by_1989_rule_ || end.status != path_status::solved) end.has_equilibrium = now_->has_equilibrium();
  end.by_1989_rule = by_1989_rule_;
  end.opened = now_->last_opened;
  if (!reached_) {
    end.status = path_status::not_factored;
    end.pairs.clear();
  }
  return end;
}

/// The paper's loop.
path_end path::loop() {
  for (int number = 1; number <= increments_allowed_; ++number) {
    const response w_star = policy_->respond();  // K w* = R*, with the springs of the pairs now in contact
    if (w_star == response::none) return set_free();
    const std::optional<double> s_min = policy_->decide();  // the kernel returns s_min and toggles statuses
    if (!s_min) return set_free();
    const bool moved = now_->advance(*s_min);                               // D <- D + s_min d*
    if (w_star == response::elastic) now_->residual.share *= 1.0 - *s_min;  // R* <- (1 - s_min) R*
    now_->tell_increment(number, *s_min, w_star == response::rigid);
    if (!policy_->goes_on()) return ended(path_status::mechanism, now_->opened());
    now_->switch_springs();  // the springs of the pairs in now_->events
    if (*s_min == 1.0) return ended(path_status::solved);
    if (now_->cycles.repeats(moved, now_->status, now_->events))
      return ended(path_status::cycle, now_->cycles.restless_pairs());
  }
  return ended(path_status::iteration_limit, now_->cycles.restless_pairs());
}

path_end path::ended(path_status status, std::vector<int> pairs) const {
  return {status, now_->step, now_->fraction(), std::move(pairs)};
}

/// Ends the path in a mechanism. Puts the pairs of the last separation back in contact, so that their springs
/// hold the structure without force; they are reported as separated.
path_end path::set_free() {
  reported_ = now_->status;
  for (const int pair : now_->last_opened) now_->status[pair] = in_contact;
  now_->find_events();
  now_->switch_springs();
  return ended(path_status::mechanism, now_->last_opened);
}

void path::reach() {
  std::vector<double> u(now_->total.size());
  const bool is_held = policy_->displace(u);
  if (!is_held) u = now_->shape;
  if (is_held && !std::ranges::all_of(u, [](double x) { return std::isfinite(x); })) return;
  rcond_ = is_held ? policy_->reciprocal_condition() : 0.0;
  now_->to_displacement(u);
  reached_ = {.step = now_->step,
              .fraction = now_->fraction(),
              .displacement = std::move(u),
              .isep = reported_.value_or(now_->status)};
}

double path::go_on_from(const structure_state& s) {
  const bool is_own = reached_ && s.from == origin::path;
  if (!by_1989_rule_ && s.fraction == 1.0) {
    const bool same_statuses = s.isep == now_->status;
    // If the path reached this state itself, it keeps its own displacements.
    now_->put_at(is_own ? reached_->displacement : s.displacement, s.isep);
    if (!is_own || !same_statuses) rcond_ = policy_->reciprocal_condition();
  }
  now_->keep_shape(s);
  return rcond_;
}

}  // namespace contct
