// How a path ended, and what to be warned of, in words.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"
#include "contct/write/exit_status.hpp"
#include "contct/write/step_results.hpp"

namespace contct::write {

/// Why a path did not reach its end: step, share of its load, and the pairs that had to do with
/// it. Empty for a path that did.
[[nodiscard]] std::string end_words(const problem& p, const path_end& end);

/// What the program ends with after such a path, where the kernels agree.
[[nodiscard]] exit_status status_of(path_status status);

/// "8 calls, 64 values compared, 0 mismatches", of what compares the calls of a path.
template <class Comparing>
[[nodiscard]] std::string counts_of(const Comparing& c) {
  return fmt::format("{} calls, {} values compared, {} mismatches", c.calls(), c.compared().values,
                     c.compared().mismatches);
}

/// A warning where too few digits of the end of a step are left to rely on; empty otherwise.
[[nodiscard]] std::string digit_warning(std::span<const step_record> steps);

/// A warning where, at the end of a step, a beam passes through a face between pairs, and its remedy; empty
/// where it does not.
[[nodiscard]] std::string passage_warning(const problem& p, std::span<const step_record> steps);

/// What is wrong with the ends of steps, and what to do about it.
[[nodiscard]] std::vector<std::string> complaints_of(const run_result& r);

/// The same, why the path ended, and warnings.
[[nodiscard]] std::vector<std::string> end_messages(const run_result& r);

}  // namespace contct::write
