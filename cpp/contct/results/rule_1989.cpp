#include "contct/results/rule_1989.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/long_system.hpp"
#include "contct/results/envelope.hpp"
#include "contct/results/quantities.hpp"

namespace contct {
namespace {

/// The requested engine; by default that of 1989, unless it takes over 0.1 s and no calls are kept.
std::string engine_of_1989(const run_result& answer, const run_request& wanted, bool calls_are_kept,
                           const kernel_facts& leader) {
  constexpr double most_work = 1e8;       // multiplications in about 0.1 s
  constexpr double of_each_column = 200;  // further work on a column, converted to multiplications
  if (!wanted.engine.empty() || calls_are_kept) return engine_for(leader, wanted.engine, answer.structure);
  const linear_structure& s = answer.structure;
  if (!s.stiffness.is_band()) return std::string(quickest_engine(s));
  double increments = 1.0;
  for (const solved_step& step : answer.record.steps)
    increments += static_cast<double>(step.increments.size());
  const double width = *s.stiffness.subdiagonals + 1.0;
  const bool is_short = increments * s.dofs() * (width * width + of_each_column) <= most_work;
  return is_short ? "refactor" : std::string(quickest_engine(s));
}

/// Removes event `e` (at share `at`, if given) from `from`. Returns its share; empty if it is not found.
std::optional<double> take_event(std::vector<timed_event>& from, const event& e, std::optional<double> at) {
  const auto found = std::find_if(from.begin(), from.end(), [&](const timed_event& t) {
    return t.what == e && (!at || std::abs(t.fraction - *at) <= same_share);
  });
  if (found == from.end()) return std::nullopt;
  const double share = found->fraction;
  from.erase(found);
  return share;
}

/// Compares a step with `others`, the events of the 1989 path up to share `limit`, where that path ended.
/// Removes events of both paths from `others`; lists each other event at the next increment of the answer.
std::vector<row_of_1989> rows_of(const solved_step& answer, std::vector<timed_event>& others, double limit) {
  std::vector<row_of_1989> rows(answer.increments.size());
  std::vector<std::pair<row_of_1989*, event>> alone;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].reached = answer.increments[i].fraction <= limit + same_share;
    for (const event& e : answer.increments[i].events)
      if (!take_event(others, e, answer.increments[i].fraction)) alone.emplace_back(&rows[i], e);
  }
  for (const auto& [row, e] : alone) {
    const std::optional<double> at = take_event(others, e, std::nullopt);
    if (at || row->reached) row->otherwise.push_back({e, at});
  }
  for (std::size_t i = 0; const timed_event& e : others) {
    while (i + 1 < rows.size() && answer.increments[i].fraction < e.fraction) ++i;
    if (!rows.empty()) rows[i].otherwise.push_back({e.what, e.fraction});
  }
  return rows;
}

/// The end of a step, from 1, on the 1989 path; null if the path has none.
const solved_step* step_of(const rule_1989& r, int step) {
  const auto found = std::ranges::lower_bound(r.record.steps, step, {}, &solved_step::step);
  return found != r.record.steps.end() && found->step == step ? &*found : nullptr;
}

/// Compares the events up to the end of the path that ended first.
void compare_events(const run_result& answer, rule_1989& r) {
  for (const solved_step& mine : answer.record.steps) {
    if (!r.only.empty() && !r.only.contains(mine.step)) {
      r.rows.emplace_back();
      continue;
    }
    std::vector<timed_event> others;
    double limit = -1.0;
    if (const solved_step* const its = step_of(r, mine.step)) {
      for (const increment_record& i : its->increments)
        for (const event& e : i.events)
          if (i.fraction <= mine.fraction + same_share) others.push_back({i.step, i.fraction, e});
      limit = its->fraction;  // less than 1 if the path ended early
    }
    r.rows.push_back(rows_of(mine, others, limit));
    r.same_events = r.same_events && others.empty();
    for (const row_of_1989& row : r.rows.back()) r.same_events = r.same_events && row.otherwise.empty();
  }
}

/// Keeps the largest difference among those that exceed the error of the answer and the rounding of doubles.
struct end_comparison {
  const certificate& answer;
  state_difference worst;

  void take(quantity q, double value, double right, double rounding, const auto& place) {
    if (!answer.allowed[q]) return;  // without a bound, different numbers may be right
    const double off = std::abs(value - right);
    if (off <= answer.error[q].value_or(0.0) + rounding) return;
    const double share = share_of(off, answer.allowed[q]);
    if (share > worst.share) worst = {worst.step, q, place(), value, right, share};
  }
};

std::string place_on(const problem& p, on list, std::size_t i, std::size_t of_element) {
  if (list == on::pairs) return numbered_words(p, list, i);
  if (list == on::element_ends) return fmt::format("element {}", i / of_element + 1);
  return "the support at " + entry_words(p, on::supports, i);
}

/// Bounds on the rounding of the numbers of a state. A path in doubles solves, in each step, equations whose
/// row i is off by at most g_i: `share` times the sum of the magnitudes of the row's terms (loads, K_ij u_j
/// with prescribed displacements, contact forces). The least eigenvalue of S K_A S, with 1 on the diagonal,
/// is at least its reciprocal condition, so the state is off by at most rho = |S g| / sqrt(rcond) in the norm
/// of K_A. Bounds on numbers follow from rho as in reference/certificate-proof.md; each number also has the
/// rounding of its own terms. The rho of successive steps are added until a step starts from zero.
class path_rounding {
 public:
  /// `p` must outlive this object.
  explicit path_rounding(const problem& p) : system_(long_system_of(p)) {}

  /// Adds the next step. The functions below are about the end of this step.
  void add(const solved_step& s) {
    const long_loads& loads = system_.at_end_of(s.step);
    if (loads.from_zero) {
      rho_ = 0.0;
      rcond_ = 1.0;
    }
    u_.assign(s.displacement.begin(), s.displacement.end());
    elements_ = system_.element_values(s.step, u_);
    noise_ = system_.residual(u_, loads).slack;  // 2 long_rounding times the sum of the magnitudes
    diagonal_.clear();
    for (const double root : system_.root) diagonal_.push_back(root * root);
    for (std::size_t i = 0; i < system_.pairs.size(); ++i)
      if (const long_pair& p = system_.pairs[i]; s.closed(i))
        for (const int dof : {p.dof, p.other})
          if (dof >= 0) diagonal_[dof] += p.stiffness.hi;
    double square = 0.0;
    for (std::size_t dof = 0; dof < diagonal_.size(); ++dof) {
      noise_[dof] *= share / (2 * long_rounding);
      if (system_.fixed[dof] == 0) square += noise_[dof] * noise_[dof] / diagonal_[dof];
    }
    rcond_ = std::min(rcond_, s.rcond);
    rho_ += std::sqrt(square / s.rcond);
  }

  [[nodiscard]] double of_displacement(std::size_t dof) const {
    const double own = share * std::abs(u_[dof].hi);
    return system_.fixed[dof] != 0 ? own : own + rho_ / std::sqrt(diagonal_[dof] * rcond_);
  }
  [[nodiscard]] double of_pair(std::size_t pair) const {
    const long_pair& p = system_.pairs[pair];
    const double reach = of_displacement(p.dof) + (p.other < 0 ? 0.0 : of_displacement(p.other));
    return of_spring(p.stiffness.hi, reach) + share * p.stiffness.hi * system_.size_of_depth(pair, u_);
  }
  [[nodiscard]] double of_support(std::size_t support) const {
    const auto& s = system_.supports[support];
    if (s.fixed) return system_.root[s.dof] * rho_ + noise_[s.dof];
    return of_spring(s.spring.hi, of_displacement(s.dof)) + share * s.spring.hi * std::abs(u_[s.dof].hi);
  }
  /// `value`: as in element_results.
  [[nodiscard]] double of_element(std::size_t value) const {
    return elements_[value].energy * rho_ + share * elements_[value].size;
  }

 private:
  /// Allows for the constants of a band's factorisation, and for several solves in a step.
  static constexpr double share = 16 * 0x1p-53;

  [[nodiscard]] double of_spring(double stiffness, double reach) const {
    return std::min(std::sqrt(stiffness) * rho_, stiffness * reach);
  }

  long_system system_;
  long_vector u_;
  std::vector<double> noise_;     // the sum of the magnitudes in each row, times `share` [dofs]
  std::vector<double> diagonal_;  // of K_A [dofs]
  std::vector<element_value> elements_;
  double rho_ = 0.0, rcond_ = 1.0;
};

/// `rounding`: at the end of the step; null: none.
state_difference difference_of(const run_result& answer, const structure_state& right,
                               const structure_state& other, const certificate& c,
                               const path_rounding* rounding) {
  const problem& p = answer.what;
  const step_results a(p, other);
  const step_results b(p, right);
  end_comparison all{c, {right.step}};
  for (int dof = 0; dof < std::ssize(right.displacement); ++dof)
    all.take(answer.structure.deflects(dof) ? quantity::w : quantity::slope, other.displacement[dof],
             right.displacement[dof], rounding == nullptr ? 0.0 : rounding->of_displacement(dof),
             [&] { return place_words(p.geometry, dof / answer.structure.dofs_per_node); });
  const auto noise = [&](on list, std::size_t i) {
    if (rounding == nullptr) return 0.0;
    return list == on::pairs      ? rounding->of_pair(i)
           : list == on::supports ? rounding->of_support(i)
                                  : rounding->of_element(i);
  };
  const std::size_t kinds = b.elements.names.size();
  const auto places = static_cast<std::size_t>(std::max(b.elements.places, 1));
  std::size_t number = 0;  // of the row among those of elements
  for (const quantity_row* row : quantities_of(p)) {
    const bool in_elements = row->where == on::element_ends;
    const bool is_force = in_elements || row->where == on::supports || row->kind == quantity::force;
    if (!row->kind || !is_force) continue;
    const std::vector<double> found = row->values(a);
    const std::vector<double> wanted = row->values(b);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (std::isnan(wanted[i])) continue;  // a support with the other kind of reaction
      const std::size_t at = in_elements ? (i / places * kinds + number) * places + i % places : i;
      all.take(*row->kind, found[i], wanted[i], noise(row->where, at),
               [&] { return place_on(p, row->where, i, places); });
    }
    if (in_elements) ++number;
  }
  return all.worst;
}

void compare_states(const run_result& answer, rule_1989& r) {
  std::optional<path_rounding> rounding;  // made for the first step that seems wrong
  std::size_t added = 0;                  // the steps in `rounding`
  for (const solved_step& right : answer.record.steps) {
    const solved_step* const its = step_of(r, right.step);
    if (its == nullptr) continue;
    const structure_state& other = *its;
    const std::optional<certificate>& c = right.judged;
    if (!c || !c->certified || other.fraction != 1.0) continue;
    const auto compared = [&](const path_rounding* noise) {
      return difference_of(answer, right, other, *c, noise);
    };
    state_difference d = compared(nullptr);
    if (d.is_wrong()) {
      if (!rounding) rounding.emplace(answer.what);
      for (; added <= static_cast<std::size_t>(its - r.record.steps.data()); ++added)
        rounding->add(r.record.steps[added]);
      d = compared(&*rounding);
      d.but_for_rounding = !d.is_wrong();
    }
    r.differences.push_back(std::move(d));
  }
}

/// True if the load of a step has an equilibrium; empty if the path of the answer does not show this.
std::optional<bool> has_equilibrium(const run_result& answer, int step) {
  if (step < answer.end.step || answer.end.status == path_status::solved) return true;
  return step == answer.end.step ? answer.end.has_equilibrium : std::nullopt;
}

}  // namespace

rule_1989::rule_1989(std::string engine_name, recorded_parts parts)
    : engine(std::move(engine_name)),
      compared(facts_of_kernel(kernels_of_1989.front()), std::span(kernels_of_1989).subspan(1)) {
  record = run_recorder(&compared, parts);
}

std::shared_ptr<const rule_1989> follow_rule_1989(const run_result& answer, const run_request& wanted,
                                                  bool calls_are_kept, recorded_parts parts,
                                                  const std::vector<observer*>& shown) {
  const std::unique_ptr<kernel> leader = make_kernel(kernels_of_1989.front());
  const auto r =
      std::make_shared<rule_1989>(engine_of_1989(answer, wanted, calls_are_kept, leader->facts()), parts);
  std::vector<observer*> all = {&r->compared};
  all.insert(all.end(), shown.begin(), shown.end());
  all.push_back(&r->record);
  constexpr std::size_t enough = 20;
  if (!wanted.compare_all && !calls_are_kept && starts_from_zero(answer.what) &&
      answer.what.steps.size() > enough)
    r->only = governing_steps(answer, enough);
  r->take(follow(answer.what, answer.structure, r->engine, *leader, all, nullptr, wanted.max_increments,
                 r->only));
  const auto decide = [&answer](path_end& end) {
    if (end.status != path_status::solved && !end.has_equilibrium)
      end.has_equilibrium = has_equilibrium(answer, end.step);
    end.conclude();
  };
  decide(r->end);
  for (path_end& other : r->end.others) decide(other);
  compare_events(answer, *r);
  compare_states(answer, *r);
  return r;
}

}  // namespace contct
