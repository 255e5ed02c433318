// The hunt on calls: random and adversarial ones put to a leader and to others, compared to the bit.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contct/compare/branches.hpp"
#include "contct/compare/mismatch_report.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/lab/adversarial_calls.hpp"
#include "contct/lab/random_calls.hpp"

namespace contct {

/// The calls of a hunt, each a function of the seed and its number alone: odd numbers are random, even ones
/// adversarial.
class call_source {
 public:
  /// `real_bytes`: 8, or 4 for numbers and thresholds of single precision.
  call_source(std::uint64_t seed, int real_bytes);
  /// Call `number`, from 1; the reference is good until the one after.
  const call_inputs<double>& at(std::uint64_t number);

 private:
  int real_bytes_;
  random_calls<double> random_r8_;
  adversarial_calls<double> adversarial_r8_;
  random_calls<float> random_r4_;
  adversarial_calls<float> adversarial_r4_;
  call_inputs<double> wide_;
};

/// Events by kind. A pair at its face when its event came is counted as stationary, too.
struct event_counts {
  std::int64_t make = 0, break_ = 0, stationary = 0;
};

/// Count the pairs that a call toggled.
void count_toggles(const call<double>& answered, std::span<const int> isep_before, event_counts& counts);

/// How near a follower came where it did not come to the bit.
struct nearness {
  std::uint64_t most_ulps = 0;  ///< of SMIN and SS, over all calls
  bool same_events = true;      ///< ISEP was equal in all calls
  bool always_answered = true;

  /// Take in a call that diverged.
  void take_in(const call<double>& leader, const call_outputs& follower, const mismatch& d);
};

/// What is known of one follower.
struct campaign_follower {
  std::string name;
  tally compared;
  nearness near;
  std::vector<mismatch_report> mismatch_reports;  ///< the first ones, at most one a field
  std::vector<std::uint64_t> calls;               ///< their numbers
};

/// Puts calls to a leader and its followers. SMIN, SS and ISEP are compared at once, the unit-26 text in
/// blocks: reading it back after every call would cost several times the call.
class call_campaign {
 public:
  /// Throws std::invalid_argument for kernels that are unknown, or of another precision or rule.
  call_campaign(const std::string& leader, const std::vector<std::string>& followers, std::uint64_t seed);
  ~call_campaign();

  /// Put calls `first`, `first + stride`, ... up to `last` to all.
  void put(std::uint64_t first, std::uint64_t last, std::uint64_t stride,
           const std::function<void(std::uint64_t done)>& progress = nullptr);

  [[nodiscard]] std::int64_t calls() const { return calls_; }
  [[nodiscard]] const branch_counts& branches() const { return branches_; }
  [[nodiscard]] const event_counts& events() const { return events_; }
  [[nodiscard]] const std::vector<campaign_follower>& followers() const { return followers_; }
  [[nodiscard]] int real_bytes() const;

 private:
  void put_one(std::uint64_t number);
  void compare_texts();
  void find_text_difference(std::size_t follower);
  void note(std::size_t follower, std::uint64_t number, const mismatch& d, const call<double>& answered,
            const call_inputs<double>& in);

  std::unique_ptr<kernel> leader_;
  std::vector<std::unique_ptr<kernel>> kernels_;
  std::vector<campaign_follower> followers_;
  call_source source_;
  call_outputs leads_, follows_;
  std::vector<std::uint64_t> block_;  // numbers of the calls whose text is gathered
  std::vector<std::string> texts_;
  std::int64_t calls_ = 0;
  branch_counts branches_;
  event_counts events_;
};

}  // namespace contct
