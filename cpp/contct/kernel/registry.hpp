// Any kernel by its name: built in, a plug-in, or a command.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// Make a kernel by name: a built-in one, "plugin:LIBRARY" or "pipe:COMMAND". Throws std::invalid_argument,
/// listing the valid names, if the name is unknown.
[[nodiscard]] std::unique_ptr<kernel> make_kernel(std::string_view name);

/// Makes kernels by their names; make_kernel, or a function that knows more kernels.
using kernel_maker = std::function<std::unique_ptr<kernel>(std::string_view name)>;

/// What the kernel of that name is, without making it. Throws as make_kernel does.
[[nodiscard]] kernel_facts facts_of_kernel(std::string_view name);

}  // namespace contct
