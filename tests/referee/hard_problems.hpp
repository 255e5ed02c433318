// Draws small random problems that are hard for double precision, the same on every machine. Every number has
// at most 15 decimal digits, so that a file gives exactly the number of the double.
#pragma once

#include <cstdint>
#include <string_view>

#include "contct/model/problem.hpp"

namespace contct::referee {

/// Reasons why a problem is hard.
enum class hard_kind {
  stiff_pairs,        ///< pairs are up to 1e18 times as stiff as the beam
  drops,              ///< a free beam falls on its pairs from up to 1e6 times its length
  small_after_large,  ///< a load is 1e4 to 1e12 times smaller than the load before it
  cancelling_loads,   ///< large loads have a small resultant
  graded_meshes,      ///< elements are 1e5 times as long as others, or far from x = 0
  pairs_alone,        ///< no supports, mixed gaps, and loads that move the beam
  near_tipping,       ///< a load over the first or last pair, with a tiny moment or none
  soft_matrices,      ///< [[1, -1], [-1, 1 + eps]]
  spring_decades,     ///< elastic supports and pairs over 16 decades
};
inline constexpr int hard_kinds = 9;

[[nodiscard]] std::string_view name_of(hard_kind k);

/// Returns problem `number` of `seed`.
[[nodiscard]] problem make_hard_problem(std::uint64_t seed, std::uint64_t number, hard_kind kind);

}  // namespace contct::referee
