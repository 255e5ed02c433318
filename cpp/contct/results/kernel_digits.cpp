#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

#include "contct/proof/long_system.hpp"
#include "contct/results/exact_run.hpp"

namespace contct {
namespace {

constexpr double all_digits = 16.0;

double digits_of(double relative_error) {
  if (relative_error >= 1.0) return 0.0;
  return relative_error > 0.0 ? std::min(-std::log10(relative_error), all_digits) : all_digits;
}

double digits_of(const rational& error, const rational& largest) {
  if (error == 0) return all_digits;
  return largest == 0 ? 0.0 : digits_of(rounded(error / largest));
}

/// |x - exactly|; more than `largest` if x is not finite, so that no digit is right.
rational error_of(double x, const rational& exactly, const rational& largest) {
  return std::isfinite(x) ? rational(abs(binary_value(x) - exactly)) : rational(largest + 1);
}

/// The largest exact displacement of each kind of dof. A kind whose numbers are all 0 by symmetry gets its
/// size from the other kind.
rational_vector largest_displacements(const problem& p, const exact_path& exactly) {
  rational_vector largest(dofs_per_node(p.geometry));
  for (const exact_step_end& s : exactly.steps)
    for (std::size_t dof = 0; dof < s.displacement.size(); ++dof) {
      rational& most = largest[dof % largest.size()];
      most = std::max(most, rational(abs(s.displacement[dof])));
    }
  const double span = extent_of(p.geometry);  // 0 for a matrix, which has one kind of dof
  const rational length = span > 0.0 ? binary_value(span) : rational(1);
  const rational slope_of_w = largest[0] / length;
  for (std::size_t kind = 1; kind < largest.size(); ++kind)
    largest[kind] = std::max(largest[kind], slope_of_w);
  const rational slope = *std::max_element(largest.begin() + (largest.size() > 1 ? 1 : 0), largest.end());
  if (largest[0] == 0) largest[0] = slope * length;
  for (std::size_t kind = 1; kind < largest.size(); ++kind)
    if (largest[kind] == 0) largest[kind] = slope;
  return largest;
}

void compare_ends(kernel_digits& r, const problem& p, const exact_path& exactly,
                  const std::vector<solved_step>& steps) {
  const rational_vector largest = largest_displacements(p, exactly);
  rational_vector error(largest.size());
  rational largest_force;
  rational force_error;
  for (const exact_step_end& s : exactly.steps)
    for (const rational& force : s.force) largest_force = std::max(largest_force, rational(abs(force)));
  for (const solved_step& s : steps) {
    const auto step = static_cast<std::size_t>(s.step - 1);
    if (s.fraction != 1.0 || step >= exactly.steps.size() || exactly.steps[step].fraction != 1) continue;
    ++r.steps;
    const exact_step_end& right = exactly.steps[step];
    for (std::size_t dof = 0; dof < s.displacement.size(); ++dof) {
      const std::size_t kind = dof % error.size();
      error[kind] =
          std::max(error[kind], error_of(s.displacement[dof], right.displacement[dof], largest[kind]));
    }
    const statics<double> numbers = statics_of(p, p.steps[step], s.displacement, s.isep, s.numbers);
    for (std::size_t i = 0; i < s.isep.size(); ++i)
      force_error = std::max(force_error, error_of(numbers.pair_forces[i], right.force[i], largest_force));
  }
  for (std::size_t kind = 0; kind < error.size(); ++kind)
    r.digits = std::min(r.digits, digits_of(error[kind], largest[kind]));
  r.force_digits = digits_of(force_error, largest_force);
}

/// An event. `place`: number of the step, from 0, plus share of the step.
struct placed_event {
  double place;
  event what;
};
using event_list = std::vector<placed_event>;

event_list events_on(const recorded_path& path) {
  event_list events;
  for (const timed_event& e : events_of(path.record)) events.push_back({e.step - 1 + e.fraction, e.what});
  return events;
}

event_list events_on(const exact_path& exactly) {
  event_list events;
  for (std::size_t step = 0; step < exactly.steps.size(); ++step)
    for (const exact_increment& i : exactly.steps[step].increments)
      for (const event& e : i.events) events.push_back({static_cast<double>(step) + rounded(i.fraction), e});
  return events;
}

/// True if the exact path does not decide the event: the event is at the end of a step, where the contact
/// pair is exactly at its face without force, so that the event may belong to this step, to the next or to
/// none; or the exact path ends at or before the event because nothing holds the structure.
bool is_ambiguous(const placed_event& e, const exact_path& exactly, double tie) {
  const auto at = std::min(exactly.steps.size() - 1, static_cast<std::size_t>(e.place));
  const path_status status = exactly.steps[at].status;
  const double reached = static_cast<double>(at) + rounded(exactly.steps[at].fraction);
  const bool nothing_holds = status == path_status::mechanism || status == path_status::path_ended;
  if (nothing_holds && e.place > reached - tie) return true;
  const double end = std::round(e.place);
  if (std::abs(e.place - end) > tie || end < 1.0 || end > static_cast<double>(exactly.steps.size()))
    return false;
  const exact_step_end& s = exactly.steps[static_cast<std::size_t>(end) - 1];
  return s.fraction == 1 && s.gap[e.what.pair] == 0 && s.force[e.what.pair] == 0;
}

/// `events` without those that the exact path does not decide, and without opposite events of the same
/// contact pair whose places differ by less than `tie`.
event_list decided(const event_list& events, const exact_path& exactly, double tie) {
  event_list kept;
  for (const placed_event& e : events) {
    if (is_ambiguous(e, exactly, tie)) continue;
    const auto before = std::find_if(kept.rbegin(), kept.rend(),
                                     [&e](const placed_event& k) { return k.what.pair == e.what.pair; });
    if (before != kept.rend() && e.place - before->place < tie) {
      kept.erase(std::next(before).base());
    } else {
      kept.push_back(e);
    }
  }
  return kept;
}

std::string words(const placed_event& e) {
  const double step = std::floor(e.place);
  char share[32];
  (void)std::snprintf(share, sizeof share, "%.9g", e.place - step);
  return "pair " + std::to_string(e.what.pair + 1) +
         (e.what.what == change::make ? " makes contact" : " breaks contact") + " in step " +
         std::to_string(static_cast<int>(step) + 1) + " at share " + share;
}

/// Compares the events of both paths in order; events within `tie` of each other are first sorted by pair.
void compare_events(kernel_digits& r, event_list exactly, event_list seen, double tie) {
  for (std::size_t first = 0, end = 0; first < exactly.size(); first = end) {
    while (end < exactly.size() && exactly[end].place - exactly[first].place < tie) ++end;
    for (event_list* const all : {&exactly, &seen}) {
      const std::span<placed_event> of_tie(*all);
      const std::size_t most = all->size();
      std::ranges::sort(of_tie.subspan(std::min(first, most), std::min(end, most) - std::min(first, most)),
                        {}, [](const placed_event& e) { return std::pair(e.what.pair, e.what.what); });
    }
  }
  double error = 0.0;
  for (std::size_t i = 0; i < std::max(exactly.size(), seen.size()) && r.same_events; ++i) {
    r.same_events = i < exactly.size() && i < seen.size() && exactly[i].what == seen[i].what;
    if (r.same_events)
      error = std::max(error, std::abs(seen[i].place - exactly[i].place));
    else if (i >= exactly.size())
      r.first_difference = words(seen[i]) + ", which does not happen on the exact path";
    else
      r.first_difference = "the exact path: " + words(exactly[i]) +
                           "; this kernel: " + (i < seen.size() ? words(seen[i]) : "no further event");
  }
  r.event_digits = digits_of(error);
}

}  // namespace

kernel_digits digits_on(const recorded_path& path, const std::string& kernel, const problem& p,
                        const exact_path& exactly, double tie) {
  kernel_digits r;
  r.name = kernel;
  compare_events(r, decided(events_on(exactly), exactly, tie), decided(events_on(path), exactly, tie), tie);
  if (r.same_events && path.end.status != exactly.status()) {
    r.same_events = false;
    r.first_difference = exactly.status() == path_status::solved
                             ? "the path ends before the full load; the exact path does not"
                             : "the path ends differently from the exact path";
  }
  compare_ends(r, p, exactly, path.record.steps);
  return r;
}

}  // namespace contct
