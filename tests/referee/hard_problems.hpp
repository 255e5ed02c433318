// Random problems that are small and hard for double precision, the same everywhere from a seed and a number.
// Every number is a decimal of at most 15 digits, so that a file gives exactly the number that the double
// represents.
#pragma once

#include <cstdint>
#include <string_view>

#include "contct/model/problem.hpp"

namespace contct::referee {

/// The reason why a problem is hard.
enum class hard_kind {
  stiff_pairs,        ///< pairs up to 1e18 times as stiff as the beam
  drops,              ///< a free beam falls on its pairs from up to 1e6 times its length
  small_after_large,  ///< a load 1e4 to 1e12 times smaller than the one before it
  cancelling_loads,   ///< large loads with nothing but a small resultant
  graded_meshes,      ///< elements 1e5 times as long as others, or far from x = 0
  pairs_alone,        ///< no supports, mixed gaps, loads that move the beam about
  near_tipping,       ///< the load acts over the last pair, with a moment of 1e-8 to 1e-16 of it
  soft_matrices,      ///< [[1, -1], [-1, 1 + eps]]
  spring_decades,     ///< elastic supports and pairs over 16 decades
};
inline constexpr int hard_kinds = 9;

[[nodiscard]] std::string_view name_of(hard_kind k);

/// Problem `number` of `seed`.
[[nodiscard]] problem make_hard_problem(std::uint64_t seed, std::uint64_t number, hard_kind kind);

}  // namespace contct::referee
