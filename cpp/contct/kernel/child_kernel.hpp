// External kernels: a shared library with the plug-in ABI, or a command that speaks the trace format.
// Each has a process of its own: it may crash, hang or answer nonsense, and the run goes on.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// How long an external kernel may take for one call, and after how many failures it is given up. A crash
/// costs a millisecond, and many may show what they have in common; a timeout costs the user `patience`.
struct outside_limits {
  std::chrono::milliseconds patience{10'000};
  int most_failures = 1000;
  int most_waits = 3;
};

/// "plugin:PATH". The library is loaded, and every call made, in a child process. Throws
/// std::invalid_argument when it cannot be loaded, lacks a symbol, or has another ABI.
[[nodiscard]] std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& limits = {});

/// "pipe:COMMAND", run by the shell.
[[nodiscard]] std::unique_ptr<kernel> make_pipe(const std::string& command,
                                                const outside_limits& limits = {});

}  // namespace contct
