// Tier 1: each call that a leader answers goes to other kernels, and is compared to the bit.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/compare/compare.hpp"

namespace contct {

/// Puts each call that the leader answered to every follower, with identical inputs, and compares SMIN, all
/// of SS, all of ISEP and the unit-26 text.
class lockstep {
 public:
  /// Throws std::invalid_argument when a follower has another precision or rule than the leader.
  lockstep(const kernel_facts& leader, std::vector<std::unique_ptr<kernel>> followers);
  /// With kernels by name: all are known, and refused by their facts, before the first is made.
  lockstep(const kernel_facts& leader, std::span<const std::string> followers);

  void put(const answered_call& c);

  [[nodiscard]] std::int64_t calls() const { return calls_; }
  /// The compared values of all followers together.
  [[nodiscard]] tally compared() const;
  /// The first call in which a follower did not answer as the leader.
  [[nodiscard]] const std::optional<mismatch_report>& first() const;
  /// Did every follower answer the last call as the leader did?
  [[nodiscard]] bool last_call_equal() const;
  /// How each follower answered the last call.
  [[nodiscard]] const std::vector<follower_answer>& last_answers() const { return last_answers_; }
  [[nodiscard]] const std::vector<follower>& followers() const { return followers_; }
  [[nodiscard]] std::vector<follower>& followers() { return followers_; }

 private:
  std::vector<std::unique_ptr<kernel>> kernels_;
  std::vector<follower> followers_;
  std::int64_t calls_ = 0;
  std::vector<follower_answer> last_answers_;
};

}  // namespace contct
