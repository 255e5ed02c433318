// The kernels that are built in: the compiled listing, C++ CONTCT, and the corrected rule.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/kernel/kernel.hpp"

namespace contct::kernels {

/// "fortran", "fortran-r4", "cpp", "cpp-r4" or "corrected"; "flang" and "f2c" where built. Null when none has
/// that name.
[[nodiscard]] std::unique_ptr<kernel> make_built_in(std::string_view name);

/// What the kernel of that name is, without making it: of the FORTRAN ones there is one at a time.
[[nodiscard]] std::optional<kernel_facts> facts_of_built_in(std::string_view name);

/// The names of all built-in kernels.
[[nodiscard]] std::vector<std::string> kernel_names();

}  // namespace contct::kernels
