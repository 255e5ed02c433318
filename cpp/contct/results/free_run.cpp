#include "contct/results/free_run.hpp"

#include <algorithm>
#include <cmath>

namespace contct {
namespace {

std::string words_at(const std::vector<timed_event>& events, std::size_t i) {
  if (i >= events.size()) return "no further event";
  const timed_event& e = events[i];
  return "step " + std::to_string(e.step) + ", pair " + std::to_string(e.what.pair + 1) +
         (e.what.what == change::make ? " makes contact" : " breaks contact");
}

void compare_events(const recorded_path& leader, const recorded_path& other, free_run_difference& d) {
  const std::vector<timed_event> ours = events_of(leader.record);
  const std::vector<timed_event> theirs = events_of(other.record);
  for (std::size_t i = 0; i < std::max(ours.size(), theirs.size()); ++i) {
    const std::string led = words_at(ours, i);
    const std::string its = words_at(theirs, i);
    if (led != its) {
      d.same_events = false;
      if (d.first_difference.empty())
        d.first_difference.append("the leader: ").append(led).append("; this kernel: ").append(its);
      return;
    }
    d.fraction = std::max(d.fraction, std::abs(ours[i].fraction - theirs[i].fraction));
  }
}

/// The largest difference of deflections (or slopes) at the end of any step, relative to the largest
/// deflection (or slope) of the whole path.
double relative_difference(const recorded_path& leader, const recorded_path& other, bool of_slopes,
                           std::size_t stride) {
  double difference = 0.0;
  double largest = 0.0;
  const std::size_t steps = std::min(leader.record.steps.size(), other.record.steps.size());
  for (std::size_t step = 0; step < steps; ++step) {
    const std::vector<double>& a = leader.record.steps[step].displacement;
    const std::vector<double>& b = other.record.steps[step].displacement;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if ((i % stride != 0) != of_slopes) continue;
      difference = std::max(difference, std::abs(a[i] - b[i]));
      largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
    }
  }
  return largest > 0.0 ? difference / largest : 0.0;
}

}  // namespace

std::vector<timed_event> events_of(const run_recorder& path) {
  std::vector<timed_event> all;
  for (const solved_step& s : path.steps)
    for (const increment_record& i : s.increments)
      for (const event& e : i.events) all.push_back({i.step, i.fraction, e});
  return all;
}

double free_run_bound(const kernel_facts& leader, const kernel_facts& other) {
  return leader.real_bytes == other.real_bytes && leader.rule == other.rule ? 1e-9 : 1e-4;
}

free_run_difference compare_paths(const recorded_path& leader, const recorded_path& other, double bound,
                                  int dofs_per_node) {
  free_run_difference d;
  d.bound = bound;
  if (leader.end.status != other.end.status || leader.end.step != other.end.step) {
    d.same_end = false;
    d.first_difference = "the paths end differently";
  }
  compare_events(leader, other, d);
  for (const bool of_slopes : {false, true})
    d.displacement = std::max(d.displacement, relative_difference(leader, other, of_slopes, dofs_per_node));
  return d;
}

}  // namespace contct
