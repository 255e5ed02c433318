// Kernels from outside: a shared library with the plug-in ABI, or a command that speaks the trace format.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// How long a kernel from outside may take for one call, and how often it may fail before it is asked no
/// more. A crash costs a millisecond, and many show what they have in common; one that must be waited for
/// costs the whole patience, and the user's too.
struct outside_limits {
  std::chrono::milliseconds patience{10'000};
  int most_failures = 1000;
  int most_waits = 3;
};

/// What is known of a kernel from outside by its name alone: the listing's rule, 8-byte REAL, text only where
/// the call comes back as text.
[[nodiscard]] kernel_facts facts_of_plugin(const std::string& path);
[[nodiscard]] kernel_facts facts_of_pipe(const std::string& command);

/// "plugin:PATH". The library is loaded, and every call made, in a child process. Throws
/// std::invalid_argument when it cannot be loaded, lacks a symbol, or has another ABI.
[[nodiscard]] std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& limits = {});

/// "pipe:COMMAND", run by the shell: one call as a block of trace text in, one answer out.
[[nodiscard]] std::unique_ptr<kernel> make_pipe(const std::string& command,
                                                const outside_limits& limits = {});

/// Counts failures, and says when it is enough.
class failure_count {
 public:
  explicit failure_count(const outside_limits& limits) : limits_(limits) {}
  /// Throws kernel_failure when the kernel has failed too often to be asked again.
  void refuse_when_enough() const;
  /// Note a failure that cost no time, and throw it.
  [[noreturn]] void fail(const std::string& words);
  /// Note that there was no answer in time, and throw it.
  [[noreturn]] void fail_late(const std::string& words);

 private:
  outside_limits limits_;
  int failures_ = 0;
  int waits_ = 0;
  std::string last_;
};

}  // namespace contct
