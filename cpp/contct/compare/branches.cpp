#include "contct/compare/branches.hpp"

#include <algorithm>

namespace contct {

void branch_counts::add(const branch_counts& other) {
  std::ranges::transform(counts_, other.counts_, counts_.begin(), std::plus());
}

std::int64_t branch_counts::rarest() const {
  return *std::ranges::min_element(counts_);
}

namespace {

template <class Real>
std::optional<decision> narrowest_in(const call<Real>& c, std::span<const int> isep_before,
                                     const std::function<bool(branch, std::size_t)>& counts) {
  std::optional<decision> least;
  for_each_decision(c, isep_before, [&](branch b, std::size_t i, bool outcome, Real left, Real right) {
    if (!counts(b, i)) return;
    if (b == branch::was_separated && !least)
      least = decision{b, static_cast<int>(i), outcome, whole_numbers};
    keep_narrower(least, b, i, outcome, margin_between(left, right));
  });
  return least;
}

}  // namespace

std::optional<decision> narrowest_decision(const answered_call& c, int real_bytes,
                                           const std::function<bool(branch, std::size_t)>& counts) {
  if (real_bytes == 8) return narrowest_in(c.c, c.isep_before, counts);
  return as_float_call(c.c, [&](const call<float>& f) { return narrowest_in(f, c.isep_before, counts); });
}

std::string words_of(const decision& d) {
  std::string words = d.pair >= 0 ? "pair " + std::to_string(d.pair + 1) + ": " : "";
  words +=
      "IF (" + std::string(branch_conditions[index_of(d.what)]) + ") was " + (d.outcome ? "true" : "false");
  if (d.ulps == whole_numbers) return words;
  if (d.ulps == std::numeric_limits<std::uint64_t>::max()) return words + ", with NaN";
  if (d.ulps == 0) return words + ", exactly on the threshold";
  return words + " by " + std::to_string(d.ulps) + " ULP";
}

}  // namespace contct
