// What rational numbers decide beside a path in doubles.
#pragma once

#include <memory>
#include <optional>

#include "contct/certify/certificate.hpp"
#include "contct/exact/exact_problem.hpp"

namespace contct {

/// Where numbers of a path in doubles are asked of rational ones, structures are no larger, nor their bands
/// wider, nor numbers of the path longer, than this: it would take longer than anybody waits who did not ask
/// for exact numbers.
inline constexpr int most_dofs_beside_doubles = 1000;
inline constexpr int most_subdiagonals_beside_doubles = 64;
inline constexpr std::size_t most_bits_beside_doubles = std::size_t{1} << 14U;

/// The problem in rational numbers, where it is as small as that.
[[nodiscard]] std::optional<exact_problem> small_exact_problem_of(const problem& p);

/// Beside a path in doubles: nothing of a larger problem. `p` must outlive what is returned.
[[nodiscard]] std::unique_ptr<exact_means> exact_means_of(const problem& p);

}  // namespace contct
