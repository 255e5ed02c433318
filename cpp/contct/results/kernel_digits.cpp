#include "contct/results/kernel_digits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

#include "contct/proof/long_system.hpp"

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

}  // namespace

digit_counter::digit_counter(const problem& p, const exact_path& exactly)
    : problem_(p), exactly_(exactly), largest_(dofs_per_node(p.geometry)), error_(largest_.size()) {
  for (const exact_step_end& s : exactly.steps) {
    for (std::size_t dof = 0; dof < s.displacement.size(); ++dof) {
      rational& largest = largest_[dof % largest_.size()];
      largest = std::max(largest, rational(abs(s.displacement[dof])));
    }
    for (const rational& force : s.force) largest_force_ = std::max(largest_force_, rational(abs(force)));
  }
  // A kind whose numbers are all 0 by symmetry gets its size from the other kind.
  const double span = extent_of(p.geometry);  // 0 for a matrix, which has one kind of dof
  const rational length = span > 0.0 ? binary_value(span) : rational(1);
  const rational slope_of_w = largest_[0] / length;
  for (std::size_t kind = 1; kind < largest_.size(); ++kind)
    largest_[kind] = std::max(largest_[kind], slope_of_w);
  const rational slope = *std::max_element(largest_.begin() + (largest_.size() > 1 ? 1 : 0), largest_.end());
  if (largest_[0] == 0) largest_[0] = slope * length;
  for (std::size_t kind = 1; kind < largest_.size(); ++kind)
    if (largest_[kind] == 0) largest_[kind] = slope;
}

void digit_counter::incremented(const increment& i) {
  for (const event& e : i.events) events_.push_back({i.step - 1 + i.fraction, e});
}

void digit_counter::take(const solved_step& s) {
  const auto step = static_cast<std::size_t>(s.step - 1);
  if (s.fraction != 1.0 || step >= exactly_.steps.size() || exactly_.steps[step].fraction != 1) return;
  ++steps_;
  const exact_step_end& exactly = exactly_.steps[step];
  for (std::size_t dof = 0; dof < s.displacement.size(); ++dof) {
    const std::size_t kind = dof % error_.size();
    error_[kind] =
        std::max(error_[kind], error_of(s.displacement[dof], exactly.displacement[dof], largest_[kind]));
  }
  const statics<double> numbers =
      statics_of(problem_, problem_.steps[step], s.displacement, s.isep, s.numbers);
  for (std::size_t i = 0; i < s.isep.size(); ++i)
    force_error_ = std::max(force_error_, error_of(numbers.pair_forces[i], exactly.force[i], largest_force_));
}

/// `events` without those that the exact path does not decide, and without opposite events of the same
/// contact pair whose places differ by less than `tie`.
digit_counter::event_list digit_counter::decided(const event_list& events, double tie) const {
  event_list kept;
  for (const placed_event& e : events) {
    if (is_ambiguous_event(e, tie)) continue;
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

/// True if the exact path does not decide the event: the event is at the end of a step, where the contact
/// pair is exactly at its face without force, so that the event may belong to this step, to the next or to
/// none; or the exact path ends at or before the event because nothing holds the structure.
bool digit_counter::is_ambiguous_event(const placed_event& e, double tie) const {
  const auto at = std::min(exactly_.steps.size() - 1, static_cast<std::size_t>(e.place));
  const path_status status = exactly_.steps[at].status;
  const double reached = static_cast<double>(at) + rounded(exactly_.steps[at].fraction);
  const bool nothing_holds = status == path_status::mechanism || status == path_status::path_ended;
  if (nothing_holds && e.place > reached - tie) return true;
  const double end = std::round(e.place);
  if (std::abs(e.place - end) > tie || end < 1.0 || end > static_cast<double>(exactly_.steps.size()))
    return false;
  const exact_step_end& s = exactly_.steps[static_cast<std::size_t>(end) - 1];
  return s.fraction == 1 && s.gap[e.what.pair] == 0 && s.force[e.what.pair] == 0;
}

digit_counter::event_list digit_counter::exact_events() const {
  event_list events;
  for (std::size_t step = 0; step < exactly_.steps.size(); ++step)
    for (const exact_increment& i : exactly_.steps[step].increments)
      for (const event& e : i.events) events.push_back({static_cast<double>(step) + rounded(i.fraction), e});
  return events;
}

std::string digit_counter::words(const placed_event& e) {
  const double step = std::floor(e.place);
  char share[32];
  (void)std::snprintf(share, sizeof share, "%.9g", e.place - step);
  return "pair " + std::to_string(e.what.pair + 1) +
         (e.what.what == change::make ? " makes contact" : " breaks contact") + " in step " +
         std::to_string(static_cast<int>(step) + 1) + " at share " + share;
}

/// Compares the events of both paths in order; events within `tie` of each other are first sorted by pair.
void digit_counter::compare_events(kernel_digits& r, double tie) const {
  event_list exactly = decided(exact_events(), tie);
  event_list seen = decided(events_, tie);
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

kernel_digits digit_counter::result(const std::string& name, path_status ended, double tie) const {
  kernel_digits r;
  r.name = name;
  r.steps = steps_;
  compare_events(r, tie);
  if (r.same_events && ended != exactly_.status()) {
    r.same_events = false;
    r.first_difference = exactly_.status() == path_status::solved
                             ? "the path ends before the full load; the exact path does not"
                             : "the path ends differently from the exact path";
  }
  for (std::size_t kind = 0; kind < error_.size(); ++kind)
    r.digits = std::min(r.digits, digits_of(error_[kind], largest_[kind]));
  r.force_digits = digits_of(force_error_, largest_force_);
  return r;
}

}  // namespace contct
