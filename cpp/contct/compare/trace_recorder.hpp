// A path recorded: every call of the leader, as a trace.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "contct/path/observer.hpp"
#include "contct/trace/trace.hpp"

namespace contct {

/// Observes a path and hands its trace on as it grows, header first: memory does not grow with the calls.
class trace_recorder final : public observer {
 public:
  using sink = std::function<void(std::string_view text)>;
  trace_recorder(const trace_header& h, sink to);
  void called(const answered_call& c) override;

 private:
  sink to_;
  std::int64_t calls_ = 0;
  std::string text_;
};

}  // namespace contct
