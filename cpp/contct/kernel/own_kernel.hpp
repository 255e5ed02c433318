// A kernel that is a function of this process: the caller's, or a plug-in's in its own process.
#pragma once

#include <memory>
#include <string>

#include "contct/kernel/kernel.hpp"
#include "contct/kernel/plugin.h"

namespace contct {

using kernel_procedure = decltype(contct_kernel);

/// Throws std::invalid_argument where a function may not have that name, as where another kernel has it.
void refuse_name_of_function(const std::string& name);

/// Put a call to `procedure`, which gets copies of all arrays, between bytes that it must not touch. Throws
/// kernel_failure, "changed its input DD", where it wrote what it must not; `c` is then as it was.
void put_guarded(call<double>& c, kernel_procedure* procedure);

/// A kernel that is put each call by put_guarded.
[[nodiscard]] std::unique_ptr<kernel> make_function_kernel(const std::string& name,
                                                           kernel_procedure* procedure);

}  // namespace contct
