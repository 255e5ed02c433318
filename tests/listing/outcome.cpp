#include "listing/outcome.hpp"

#include <algorithm>

#include "listing/battery.hpp"

namespace contct_test {
namespace {

/// The call that did not return: the first without an answer.
std::string call_without_answer(const std::vector<answer>& answers) {
  for (const battery_call& call : battery()) {
    const auto answers_it = [&](const answer& a) { return a.call == call.name; };
    if (std::none_of(answers.begin(), answers.end(), answers_it)) return call.name;
  }
  return "";
}

}  // namespace

outcome classify(const behaviour& listing, const behaviour& copy) {
  if (!copy.compiles) return {does_not_compile, "", ""};
  if (!copy.ends_well) {
    return {copy.ends_at_bounds ? aborts_under_bounds_check : dies, call_without_answer(copy.answers), ""};
  }
  const auto [theirs, ours] =
      std::mismatch(copy.answers.begin(), copy.answers.end(), listing.answers.begin(), listing.answers.end());
  if (theirs != copy.answers.end()) return {other_numbers, theirs->call, theirs->field};
  if (ours != listing.answers.end()) return {other_numbers, ours->call, ours->field};
  if (copy.text != listing.text) return {other_text, "", ""};
  return {unnoticed, "", ""};
}

}  // namespace contct_test
