// Kernels from outside: a shared library with the plug-in ABI, or a command that speaks the trace format.
// Each has a process of its own: it may crash, hang or answer nonsense, and the run goes on.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// How long a kernel from outside may take for one call, and after how many failures it is given up. A crash
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

/// What the child of a plug-in does: load the library, say `ready_word` or what is wrong with it, and answer
/// calls until its end of the channel is closed.
void host_plugin(const std::string& path, int channel);
inline constexpr std::string_view ready_word = "ready";

/// An answer that begins with this says in its first line what the kernel did that it must not.
inline constexpr std::string_view fault_word = "fault ";

}  // namespace contct
