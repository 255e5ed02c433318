// A kernel of the caller's: a function of this process, in place of a library.
#pragma once

#include <memory>
#include <string>

#include "contct/kernel/kernel.hpp"
#include "contct/outside/plugin.h"

namespace contct::outside {

using kernel_procedure = decltype(contct_kernel);

/// Throws std::invalid_argument where a function may not have that name, as where another kernel has it.
void refuse_name_of_function(const std::string& name);

/// The inputs of `procedure` are copies, and must come back as they were: otherwise the answer is a
/// kernel_failure.
[[nodiscard]] std::unique_ptr<kernel> make_function_kernel(const std::string& name,
                                                           kernel_procedure* procedure);

}  // namespace contct::outside
