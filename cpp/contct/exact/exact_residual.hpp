// What is left of a load, without rounding, for a proof to which 32 digits are too few.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contct/exact/exact_problem.hpp"
#include "contct/numeric/double_double.hpp"

namespace contct::exact {

/// Where numbers of a path in doubles are asked of rational ones, structures are no larger, nor their bands
/// wider, than this: it would take longer than anybody waits who did not ask for exact numbers.
inline constexpr int most_dofs_beside_doubles = 1000;
inline constexpr int most_subdiagonals_beside_doubles = 64;

/// The problem in rational numbers, where it is as small as that.
[[nodiscard]] std::optional<exact_problem> small_exact_problem_of(const problem& p);

/// K u less the loads and what pairs beyond their faces press with, at every dof, each number rounded once:
/// of double_doubles u [dofs] at the end of a step of `p`, from 1. At fixed dofs u is the prescribed
/// displacement. `p` must outlive what is returned, which gives nothing for a larger problem.
[[nodiscard]] std::function<
    std::optional<std::vector<numeric::double_double>>(int step, std::span<const numeric::double_double> u)>
exact_residual_of(const problem& p);

/// Is the stiffness of `p`, without its pairs, positive semidefinite? `p` must outlive what is returned,
/// which gives nothing for a larger problem.
[[nodiscard]] std::function<std::optional<bool>()> semidefinite_test_of(const problem& p);

}  // namespace contct::exact
