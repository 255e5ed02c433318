// Observes a path: the toggles that came too early, and its trace.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/path/observer.hpp"
#include "contct/trace/trace.hpp"

namespace contct::compare {

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
