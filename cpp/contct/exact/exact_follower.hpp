// Steps that a path in doubles cannot follow, in rational numbers.
#pragma once

#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"

namespace contct::exact {

/// The longest that numbers of such a path become, in bits.
inline constexpr std::size_t most_bits_beside_doubles = std::size_t{1} << 14U;

/// Steps of the true path of `p`, which must outlive what is returned. The path is followed when the first
/// step is asked for. Nothing where it does not get to a step, is too long, or the problem is too large
/// (exact_residual.hpp).
[[nodiscard]] path::exact_follower exact_follower_of(const problem& p);

}  // namespace contct::exact
