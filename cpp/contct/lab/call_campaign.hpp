// Random and adversarial calls put to a leader and to followers, and compared to the bit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/compare/branches.hpp"
#include "contct/compare/compare.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/lab/shrink.hpp"

namespace contct::lab {

/// Events by kind. A pair at its face when its event came is counted as stationary, too.
struct event_counts {
  std::int64_t make = 0, break_ = 0, stationary = 0;
};

/// What the leader of a campaign did.
struct campaign_counts {
  std::int64_t calls = 0;
  branch_counts branches;
  event_counts events;

  /// Count a call that the leader answered.
  void count(const call<double>& answered, std::span<const int> isep_before);
  void add(const campaign_counts& other);
};

/// What came of the calls to one follower.
struct follower_result {
  tally compared;
  // How near it came where it was not equal to the bit:
  std::uint64_t most_ulps = 0;  ///< of SMIN and SS, over all calls
  bool same_events = true;      ///< ISEP was equal in all calls
  bool always_answered = true;
  std::optional<mismatch_report> first;  ///< the first mismatch
  call_sequence calls;                   ///< the calls up to it

  /// Note how near the follower came in a call whose answer differs.
  void note_difference(const call<double>& leader, const follower& f);
  /// Add the result of other calls, which were put later.
  void add(const follower_result& other);
};

/// Puts calls to a leader and its followers. SMIN, SS and ISEP are compared at once, the unit-26 text in
/// blocks: reading it back after every call would cost several times the call.
class call_campaign {
 public:
  /// Throws std::invalid_argument for kernels that are unknown, or of another precision or rule.
  call_campaign(const std::string& leader, const std::vector<std::string>& followers, std::uint64_t seed);

  /// Put calls `first`, `first + stride`, ... up to `last` to all.
  void run(std::uint64_t first, std::uint64_t last, std::uint64_t stride,
           const std::function<void(std::int64_t done)>& progress = nullptr);

  [[nodiscard]] const campaign_counts& counts() const { return counts_; }
  /// The results of the followers, each with at most 41 calls up to its first mismatch.
  [[nodiscard]] std::vector<follower_result> results();

 private:
  void put(std::uint64_t number);
  void compare_texts();
  void find_text_difference(follower& f);

  std::unique_ptr<kernel> leader_;
  std::vector<std::unique_ptr<kernel>> kernels_;
  std::vector<follower> followers_;
  std::vector<follower_result> results_;
  call_source source_;
  std::uint64_t stride_ = 1;
  call_outputs leader_outputs_;
  std::vector<std::uint64_t> block_;  // numbers of the calls whose text is not yet compared
  campaign_counts counts_;
};

}  // namespace contct::lab
