// What observes a leader's path. Tier 1: each call that it answers goes to other kernels, and is compared to
// the bit. Its trace, and the toggles that came too early.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/compare/compare.hpp"
#include "contct/path/observer.hpp"

namespace contct::compare {

/// How one follower answered one call of the leader.
struct follower_answer {
  std::int64_t values = 0, mismatches = 0;
  std::uint64_t smin_ulps = 0;  ///< distance of SMIN
  std::uint64_t ss_ulps = 0;    ///< largest distance of an s
  bool failed = false;          ///< it gave no answer
  bool same_events = true;      ///< ISEP is the leader's
};

/// Observes a path: each call that the leader answered goes to every follower, with identical
/// inputs, and SMIN, all of SS, all of ISEP and the unit-26 text are compared.
class lockstep final : public observer {
 public:
  /// Throws std::invalid_argument when a follower has another precision or rule than the leader.
  lockstep(const kernel_facts& leader, std::vector<std::unique_ptr<kernel>> followers);

  void called(const answered_call& c) override;
  /// The same for call `number`; `text` as follower::ask has it.
  void put(std::int64_t number, const call<double>& answered, std::span<const int> isep_before,
           std::optional<std::string_view> text);

  [[nodiscard]] std::int64_t calls() const { return calls_; }
  /// What was compared, of all followers together.
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
  bool leader_has_text_;
  std::vector<std::unique_ptr<kernel>> kernels_;
  std::vector<follower> followers_;
  std::int64_t calls_ = 0;
  std::vector<follower_answer> last_answers_;
};

/// A leader's lockstep with kernels by name. All are known and refused by their facts before the
/// first is made. Throws std::invalid_argument.
[[nodiscard]] lockstep make_lockstep(const kernel_facts& leader, std::span<const std::string> followers);

/// A pair that was toggled away from its face.
struct early_toggle {
  int step;         ///< from 1
  int number;       ///< of the increment, from 1
  event what;       ///< pair from 0
  double distance;  ///< from the face when it was toggled
  double share;     ///< the same, of the largest deflection at any pair so far
};

/// Observes a path and remembers the toggles that were off their face by more than rounding.
class early_toggles final : public observer {
 public:
  void called(const answered_call& c) override;
  void incremented(const increment& i) override;

  /// In the order in which they happened.
  [[nodiscard]] const std::vector<early_toggle>& all() const { return all_; }

 private:
  std::vector<double> distances_;  // of the pairs toggled in the last call; 0 of others [pairs]
  double largest_ = 0.0;
  std::vector<early_toggle> all_;
};

/// Observes a path and hands its trace on as it grows, header first: memory does not grow with the calls.
class trace_recorder final : public observer {
 public:
  using sink = std::function<void(std::string_view text)>;
  trace_recorder(const trace_header& h, sink to) : to_(std::move(to)) {
    append_header(h, text_);
    to_(text_);
  }

  void called(const answered_call& c) override {
    text_.clear();
    append_inputs(++calls_, "", c.c, c.isep_before, text_);
    append_answer(c.c.smin, c.c.ss, c.c.isep, c.text, text_);
    to_(text_);
  }

 private:
  sink to_;
  std::int64_t calls_ = 0;
  std::string text_;
};

}  // namespace contct::compare
