// External kernels: a shared library with the plug-in ABI, or a command that reads and writes the trace
// format. An external kernel runs in a child process, so that a crash, an endless loop or an invalid answer
// does not end the run. Also kernels that are functions of the calling process.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "contct/kernel/kernel.hpp"
#include "contct/kernel/plugin.h"

namespace contct {

/// The time limit of an external kernel for one call, and the numbers of failures and of timeouts after which
/// the kernel is not called again. More failures than timeouts are allowed, because a crash costs only a
/// millisecond.
struct outside_limits {
  std::chrono::milliseconds patience{10'000};
  int most_failures = 1000;
  int most_waits = 3;
};

/// Makes the kernel "plugin:PATH". A child process loads the library and makes every call. Throws
/// std::invalid_argument if the library cannot be loaded, lacks a symbol, or has another ABI version.
[[nodiscard]] std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& limits = {});

/// Makes the kernel "pipe:COMMAND". The shell runs the command.
[[nodiscard]] std::unique_ptr<kernel> make_pipe(const std::string& command,
                                                const outside_limits& limits = {});

using kernel_procedure = decltype(contct_kernel);

/// Throws std::invalid_argument if `name` is empty, is the name of a built-in kernel, or contains a colon, a
/// comma or a quote.
void refuse_name_of_function(const std::string& name);

/// Calls `procedure` with copies of all arrays between guard bytes. If `procedure` changes an input or a
/// guard byte, throws kernel_failure (for example "changed its input DD") and leaves `c` unchanged.
void put_guarded(call<double>& c, kernel_procedure* procedure);

/// Makes a kernel that answers each call with `procedure`, by put_guarded.
[[nodiscard]] std::unique_ptr<kernel> make_function_kernel(const std::string& name,
                                                           kernel_procedure* procedure);

}  // namespace contct
