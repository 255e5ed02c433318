// Which calls can be compared: those in which no whole number leaves the 32 bits of INTEGER. The result of an
// overflow is undefined in FORTRAN and in C++, and compilers differ there.
#pragma once

#include <cstdint>
#include <span>

#include "contct/kernel/call.hpp"

namespace contct::kernels {

/// Most pairs of a call: NC. The counter of the listing's DO loops ends at NC + 1.
inline constexpr std::int64_t most_pairs = 2'147'483'646;

/// Throws std::invalid_argument where NC, a product ISEP * ISURF or a dof of `c` is beyond its limit. `isep`
/// is ISEP before the call.
void refuse_beyond_limits(const call<double>& c, std::span<const int> isep);

}  // namespace contct::kernels
