// A call that one kernel has answered, put to another.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "contct/compare/compare.hpp"
#include "contct/kernel/call_inputs.hpp"
#include "contct/kernel/kernel.hpp"

namespace contct {

/// Throws std::invalid_argument when the two differ in precision or rule: their answers cannot be
/// equal to the bit.
void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower);

/// Put an answered call, whose ISEP was `isep_before`, to `follower` and compare SMIN, all of SS, all of
/// ISEP, and the text as `equality` says, where `text` is not nothing and the follower has any. A follower
/// that fails has one mismatch, in the field "answer". `out` receives its outputs.
std::optional<mismatch> put_to(kernel& follower, const call<double>& answered,
                               std::span<const int> isep_before, std::optional<std::string_view> text,
                               text_equality equality, call_outputs& out, tally& t);

}  // namespace contct
