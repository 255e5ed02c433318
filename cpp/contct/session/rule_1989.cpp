#include "contct/session/rule_1989.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/session/step_results.hpp"

namespace contct {
namespace {

/// By factorising at each increment, as in 1989, where the answer's increments take that about 0.1 s or less.
std::string engine_beside(const run_result& answer, const run_request& wanted, bool calls_are_kept,
                          const kernel_facts& leader) {
  constexpr double most_work = 1e8;       // multiplications
  constexpr double of_each_column = 200;  // what takes as long as so many, besides the factor's own
  if (!wanted.engine.empty() || calls_are_kept) return engine_for(leader, wanted.engine, answer.structure);
  const linear_structure& s = answer.structure;
  if (!s.stiffness.is_band()) return std::string(quickest_engine(s));
  double increments = 1.0;
  for (const step_record& step : answer.record.steps)
    increments += static_cast<double>(step.increments.size());
  const double width = s.stiffness.band().subdiagonals() + 1.0;
  const bool is_short = increments * s.dofs() * (width * width + of_each_column) <= most_work;
  return is_short ? "refactor" : std::string(quickest_engine(s));
}

/// Finds events of the 1989 path that are the answer's. Of one step.
class event_pairing {
 public:
  explicit event_pairing(const step_record& of_1989) {
    for (const increment_record& i : of_1989.increments)
      for (const event& e : i.events) left_[key_of(e)].push_back(i.fraction);
  }

  /// Take an event at about this share out of those that are left; false where there is none.
  bool takes(const event& e, double fraction) {
    std::vector<double>& shares = left_[key_of(e)];
    const auto at = std::find_if(shares.begin(), shares.end(),
                                 [&](double share) { return std::abs(share - fraction) <= same_share; });
    if (at == shares.end()) return false;
    shares.erase(at);
    return true;
  }

  /// The first of these events that is left, at whichever share.
  std::optional<double> first(const event& e) {
    std::vector<double>& shares = left_[key_of(e)];
    if (shares.empty()) return std::nullopt;
    const double share = shares.front();
    shares.erase(shares.begin());
    return share;
  }

  /// What is left after all.
  [[nodiscard]] std::vector<other_event> rest() const {
    std::vector<other_event> all;
    for (const auto& [known, shares] : left_)
      for (const double share : shares) all.push_back({{known.first, known.second}, share});
    return all;
  }

 private:
  using key = std::pair<int, change>;
  static key key_of(const event& e) { return {e.pair, e.what}; }

  std::map<key, std::vector<double>> left_;  // the shares of each event, in order
};

/// The rows of a step. `limit`: the share of the step at which the 1989 path ended. Events that are left go
/// to the increment that they came before; false where there is none.
bool pair_events(const step_record& answer, event_pairing& events, double limit,
                 std::vector<row_of_1989>& rows) {
  std::vector<std::pair<std::size_t, event>> alone;
  for (std::size_t i = 0; i < answer.increments.size(); ++i) {
    const increment_record& at = answer.increments[i];
    rows[i].reached = at.fraction <= limit;
    for (const event& e : at.events)
      if (!events.takes(e, at.fraction)) alone.emplace_back(i, e);
  }
  for (const auto& [i, e] : alone) {
    const std::optional<double> at = events.first(e);
    if (at || rows[i].reached) rows[i].otherwise.push_back({e, at});
  }
  const std::vector<other_event> rest = events.rest();
  for (const other_event& e : rest) {
    std::size_t i = 0;
    while (i + 1 < rows.size() && answer.increments[i].fraction < *e.at) ++i;
    if (!rows.empty()) rows[i].otherwise.push_back(e);
  }
  for (row_of_1989& row : rows)
    std::stable_sort(row.otherwise.begin(), row.otherwise.end(),
                     [](const other_event& a, const other_event& b) { return a.at < b.at; });
  return rest.empty() || !rows.empty();
}

void compare_events(const run_result& answer, rule_1989& r) {
  const step_record none{};
  for (std::size_t step = 0; step < answer.record.steps.size(); ++step) {
    const step_record& mine = answer.record.steps[step];
    const bool begun = step < r.record.steps.size();
    const step_record& other = begun ? r.record.steps[step] : none;
    const bool ended_here = r.end.status != path_status::solved && step + 1 >= r.record.steps.size();
    event_pairing events(other);
    r.rows.emplace_back(mine.increments.size());
    if (!pair_events(mine, events, !begun ? -1.0 : ended_here ? other.end.fraction : 1.0, r.rows.back()))
      r.has_further_events = true;
  }
}

/// Compares the numbers of two ends of a step, kind by kind.
struct end_comparison {
  const by_quantity& allowed;
  state_difference worst;

  void take(quantity q, state_difference::place of, std::size_t index, double value, double right) {
    if (!allowed[q]) return;  // nothing is proved of these numbers: others may be as good
    const double share = share_of(std::abs(value - right), allowed[q]);
    if (share <= worst.share) return;
    worst = {worst.step, q, of, index, value, right, share};
  }
};

state_difference difference_of(const run_result& answer, const load& l, const structure_state& right,
                               const structure_state& other, const certificate& c) {
  using place = state_difference::place;
  const linear_structure& s = answer.structure;
  const step_results a = results_of(answer.what, l, other);
  const step_results b = results_of(answer.what, l, right);
  end_comparison all{c.allowed, {right.step}};
  for (std::size_t dof = 0; dof < right.displacement.size(); ++dof)
    all.take(s.deflects(static_cast<int>(dof)) ? quantity::w : quantity::slope, place::dof, dof,
             other.displacement[dof], right.displacement[dof]);
  for (std::size_t i = 0; i < b.pairs.size(); ++i)
    all.take(quantity::force, place::pair, i, a.pairs[i].force, b.pairs[i].force);
  for (std::size_t i = 0; i < b.reactions.size(); ++i)
    all.take(answer.what.supports[i].dof == 0 ? quantity::reaction : quantity::moment, place::support, i,
             a.reactions[i], b.reactions[i]);
  const std::size_t in_element = b.elements.names.size() * b.elements.places;
  for (std::size_t i = 0; i < b.elements.values.size(); ++i) {
    const bool shear = b.elements.names[i % in_element / b.elements.places] == "shear";
    all.take(shear ? quantity::shear : quantity::moment, place::element, i / in_element, a.elements.values[i],
             b.elements.values[i]);
  }
  return all.worst;
}

void compare_states(const run_result& answer, rule_1989& r) {
  const load_path loads(answer.what);
  const std::size_t steps = std::min(answer.record.steps.size(), r.record.steps.size());
  for (std::size_t i = 0; i < steps; ++i) {
    const structure_state& right = answer.record.steps[i].end;
    const structure_state& other = r.record.steps[i].end;
    const std::optional<certificate>& c = answer.judged.steps()[i];
    if (!c || !c->certified || other.fraction != 1.0) continue;
    r.differences.push_back(difference_of(answer, loads.at(right.step, 1.0), right, other, *c));
  }
}

/// Whether the load of a step has an equilibrium, as the answer knows it.
std::optional<bool> has_equilibrium(const run_result& answer, int step) {
  if (step < answer.end.step || answer.end.status == path_status::solved) return true;
  return step == answer.end.step ? answer.end.has_equilibrium : std::nullopt;
}

}  // namespace

rule_1989::rule_1989(std::string engine_name, recorded_parts parts)
    : engine(std::move(engine_name)),
      compared(facts_of_kernel(kernels_of_1989.front()), std::span(kernels_of_1989).subspan(1)),
      record(&compared, parts) {}

bool rule_1989::same_events() const {
  bool same = !has_further_events;
  for (const auto& step : rows)
    for (const row_of_1989& row : step) same = same && row.reached && row.otherwise.empty();
  return same;
}

std::shared_ptr<const rule_1989> follow_rule_1989(const run_result& answer, const run_request& wanted,
                                                  bool calls_are_kept, recorded_parts parts,
                                                  const std::vector<observer*>& shown) {
  const std::unique_ptr<kernel> leader = make_kernel(kernels_of_1989.front());
  const auto r =
      std::make_shared<rule_1989>(engine_beside(answer, wanted, calls_are_kept, leader->facts()), parts);
  std::vector<observer*> all = {&r->compared};
  all.insert(all.end(), shown.begin(), shown.end());
  all.push_back(&r->record);
  const end_finder known = [&](int step, const full_load_state* /*reached*/) -> found_end {
    return {std::nullopt, has_equilibrium(answer, step)};
  };
  r->end = follow(answer.what, answer.structure, r->engine, *leader, all, {wanted.max_increments, known});
  compare_events(answer, *r);
  compare_states(answer, *r);
  return r;
}

}  // namespace contct
