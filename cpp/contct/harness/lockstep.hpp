// Compares kernels in lockstep, to the bit.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/harness/compare.hpp"

namespace contct {

/// Repeats each call of the leader with every follower, with identical inputs, and compares SMIN, SS, ISEP
/// and the unit-26 text.
class lockstep {
 public:
  /// Throws std::invalid_argument if a follower's precision or rule differs from the leader's.
  lockstep(const kernel_facts& leader, std::vector<std::unique_ptr<kernel>> followers);
  /// Makes the followers by name, after the precision and the rule of all of them have been checked.
  lockstep(const kernel_facts& leader, std::span<const std::string> followers);

  void put(const answered_call& c);

  [[nodiscard]] std::int64_t calls() const { return calls_; }
  /// The numbers of values and of mismatches of all followers together.
  [[nodiscard]] tally compared() const;
  /// The earliest mismatch of any follower.
  [[nodiscard]] const std::optional<mismatch_report>& first() const;
  /// True if every follower's last answer equals the leader's.
  [[nodiscard]] bool last_call_equal() const;
  /// The last answers [followers].
  [[nodiscard]] std::vector<follower_answer> last_answers() const;
  [[nodiscard]] const std::vector<follower>& followers() const { return followers_; }
  [[nodiscard]] std::vector<follower>& followers() { return followers_; }

 private:
  std::vector<std::unique_ptr<kernel>> kernels_;
  std::vector<follower> followers_;
  std::int64_t calls_ = 0;
};

}  // namespace contct
