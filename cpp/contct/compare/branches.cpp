#include "contct/compare/branches.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace contct::compare {

void branch_counts::add(const branch_counts& other) {
  std::ranges::transform(counts_, other.counts_, counts_.begin(), std::plus());
}

std::int64_t branch_counts::rarest() const {
  return *std::ranges::min_element(counts_);
}

std::vector<decision> decisions_of(const call<double>& c, std::span<const int> isep_before, int real_bytes) {
  if (real_bytes == 8) return decisions_of<double>(c, isep_before);
  return as_float_call(c, [&](const call<float>& f) { return decisions_of<float>(f, isep_before); });
}

std::optional<decision> narrowest(const std::vector<decision>& all) {
  const auto least = std::ranges::min_element(all, {}, &decision::ulps);
  return least == all.end() ? std::nullopt : std::optional<decision>(*least);
}

std::string words_of(const decision& d) {
  std::string words = d.pair >= 0 ? "pair " + std::to_string(d.pair + 1) + ": " : "";
  words +=
      "IF (" + std::string(branch_conditions[index_of(d.what)]) + ") was " + (d.outcome ? "true" : "false");
  if (d.ulps == std::numeric_limits<std::uint64_t>::max()) return words + ", with NaN";
  if (d.ulps == 0) return words + ", exactly on the threshold";
  return words + " by " + std::to_string(d.ulps) + " ULP";
}

}  // namespace contct::compare
