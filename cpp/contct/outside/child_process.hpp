// A process of one's own for a kernel from outside: it may crash, hang or lie, and the run goes on.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

namespace contct {

/// A child process and a channel to it. The child ends with this object, and with its parent.
class child_process {
 public:
  using clock = std::chrono::steady_clock;
  /// What came of a message.
  enum class sent { whole, late, gone };

  /// Fork; the child runs `body`, which gets its end of the channel and must not return to the caller's code:
  /// when it returns, the child ends. Nothing else that is open in the parent is open in the child; what
  /// it prints goes to standard error.
  explicit child_process(const std::function<void(int channel)>& body);
  ~child_process();
  child_process(const child_process&) = delete;
  child_process& operator=(const child_process&) = delete;

  [[nodiscard]] sent send(std::string_view message, clock::time_point deadline) const;
  /// Append what comes next, at least a byte, to `message`.
  [[nodiscard]] sent receive(std::string& message, clock::time_point deadline) const;

  /// Make an end of it. "was ended by signal 11 (Segmentation fault)", "ended with status 2", or, when
  /// it had to be stopped, `was_stopped`.
  std::string end();
  static constexpr const char* was_stopped = "was stopped";

 private:
  pid_t pid_ = -1;
  int channel_ = -1;
};

}  // namespace contct
