// External kernels: a shared library with the plug-in ABI, or a command that speaks the trace format. Each
// has a process of its own: it may crash, hang or answer nonsense, and the run goes on. And functions of this
// process: the caller's, or a plug-in's in its own process.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "contct/kernel/kernel.hpp"
#include "contct/kernel/plugin.h"

namespace contct {

/// How long an external kernel may take for one call, and after how many failures it is given up. A crash
/// costs a millisecond, and many crashes may show a common cause; a timeout costs the user `patience`.
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

using kernel_procedure = decltype(contct_kernel);

/// Throws std::invalid_argument if a function may not have that name, for example because another kernel has
/// it.
void refuse_name_of_function(const std::string& name);

/// Make a call of `procedure`, which gets copies of all arrays, between guard bytes. Throws kernel_failure,
/// "changed its input DD", if it wrote outside its outputs; `c` is then unchanged.
void put_guarded(call<double>& c, kernel_procedure* procedure);

/// A kernel that makes each call by put_guarded.
[[nodiscard]] std::unique_ptr<kernel> make_function_kernel(const std::string& name,
                                                           kernel_procedure* procedure);

}  // namespace contct
