// The kernels of an explanation: nobody but the listing has its lines.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// Throws std::invalid_argument unless these are one or two kernels of the 1989 rule, the first one built in.
void refuse_other_rules(const std::vector<std::string>& names);

/// The second of these, which must be comparable with the first; null where there is none. Throws as
/// make_kernel does.
[[nodiscard]] std::unique_ptr<kernel> second_kernel(const std::vector<std::string>& names);

}  // namespace contct
