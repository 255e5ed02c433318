// Makes kernels by name: built-in kernels, plug-ins and commands.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// Makes a built-in kernel, "plugin:LIBRARY" or "pipe:COMMAND". Throws std::invalid_argument, with the known
/// names, if the name is unknown.
[[nodiscard]] std::unique_ptr<kernel> make_kernel(std::string_view name);

/// make_kernel, or a function that knows more kernels.
using kernel_maker = std::function<std::unique_ptr<kernel>(std::string_view name)>;

/// The facts of a kernel, without making it. Throws as make_kernel does.
[[nodiscard]] kernel_facts facts_of_kernel(std::string_view name);

}  // namespace contct
