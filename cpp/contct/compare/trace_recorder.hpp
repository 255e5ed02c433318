// Records a path as a trace: every call of the leader.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "contct/path/observer.hpp"
#include "contct/trace/trace.hpp"

namespace contct::compare {

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
