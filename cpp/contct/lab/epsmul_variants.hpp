// The 8-byte listing with another EPSMUL: what the atlas measures, and no kernel that can be chosen.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "contct/kernel/kernel.hpp"

namespace contct::lab {

/// EPSMUL as the listing prints it.
inline constexpr double printed_epsmul = .390625E-02;

/// EPSMUL of the variants, largest first; the printed one is not among them.
[[nodiscard]] std::vector<double> epsmul_of_variants();

/// The variant of that index. It keeps no text.
[[nodiscard]] std::unique_ptr<kernel> make_epsmul_variant(std::size_t variant);

}  // namespace contct::lab
