// Kernels from outside: a shared library with the plug-in ABI, or a command that speaks the trace format.
// Each has a process of its own: it may crash, hang or answer nonsense, and the run goes on.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "contct/kernel/call_inputs.hpp"
#include "contct/kernel/kernel.hpp"

namespace contct::outside {

/// A child process and a channel to it. The child ends with this object, and with its parent.
class child_process {
 public:
  using clock = std::chrono::steady_clock;
  /// What came of a message: sent or received; not before the deadline; the channel is closed.
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

  /// End the child. "was ended by signal 11 (Segmentation fault)", "ended with status 2", or, when
  /// it had to be stopped, `was_stopped`.
  std::string end();
  static constexpr const char* was_stopped = "was stopped";

 private:
  pid_t pid_ = -1;
  int channel_ = -1;
};

/// How long a kernel from outside may take for one call, and after how many failures it is given up. A crash
/// costs a millisecond, and many may show what they have in common; a timeout costs the user `patience`.
struct outside_limits {
  std::chrono::milliseconds patience{10'000};
  int most_failures = 1000;
  int most_waits = 3;
};

/// A kernel that answers in a child process: one call as trace text in, one answer out (pipe_kernel.cpp).
class kernel_in_child : public kernel {
 public:
  [[nodiscard]] const kernel_facts& facts() const final { return facts_; }
  void answer(call<double>& c) final;
  std::string take_text() final { return std::exchange(text_, {}); }

 protected:
  kernel_in_child(kernel_facts facts, const outside_limits& limits);

  /// Make the child, ready to be asked; `fail` where it is not.
  virtual void start() = 0;
  [[nodiscard]] child_process::clock::time_point deadline() const {
    return child_process::clock::now() + limits_.patience;
  }
  /// End the child, and throw a failure, for which the caller had to wait or not.
  [[noreturn]] void fail(const std::string& words, bool waited = false);

  std::optional<child_process> child_;

 private:
  /// Throws kernel_failure when the kernel has failed too often to be asked again.
  void refuse_when_enough() const;
  /// End the child, and throw what kept a message from being sent or received whole.
  [[noreturn]] void fail_without_answer(child_process::sent how);
  void refuse_stray_answer();
  void read_answer(call<double>& c);

  kernel_facts facts_;
  outside_limits limits_;
  int failures_ = 0;
  int waits_ = 0;
  std::string last_;
  std::int64_t calls_ = 0;
  std::string asked_, answered_, text_;
  call_outputs out_;
};

/// An answer that begins with this says in its first line what the kernel did that it must not.
inline constexpr std::string_view fault_word = "fault ";

/// "plugin:PATH". The library is loaded, and every call made, in a child process. Throws
/// std::invalid_argument when it cannot be loaded, lacks a symbol, or has another ABI.
[[nodiscard]] std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& limits = {});

/// "pipe:COMMAND", run by the shell.
[[nodiscard]] std::unique_ptr<kernel> make_pipe(const std::string& command,
                                                const outside_limits& limits = {});

}  // namespace contct::outside
