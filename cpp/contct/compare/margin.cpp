#include "contct/compare/margin.hpp"

#include <algorithm>
#include <limits>

namespace contct::compare {
namespace {

constexpr std::uint64_t beyond_count = std::numeric_limits<std::uint64_t>::max();

}  // namespace

template <class Real>
std::vector<decision> decisions_of(const call<Real>& c, std::span<const int> isep_before) {
  std::vector<decision> all;
  for_each_decision(c, isep_before, [&all](branch b, std::size_t i, bool outcome, Real left, Real right) {
    if (b == branch::was_separated) return;
    all.push_back(
        {b, b == branch::no_events ? -1 : static_cast<int>(i), outcome, margin_between(left, right)});
  });
  return all;
}

std::vector<decision> decisions_of(const call<double>& c, std::span<const int> isep_before, int real_bytes) {
  if (real_bytes == 8) return decisions_of<double>(c, isep_before);
  return as_float_call(c, [&](const call<float>& f) { return decisions_of<float>(f, isep_before); });
}

std::optional<decision> narrowest(const std::vector<decision>& all) {
  const auto least = std::min_element(all.begin(), all.end(),
                                      [](const decision& a, const decision& b) { return a.ulps < b.ulps; });
  return least == all.end() ? std::nullopt : std::optional<decision>(*least);
}

std::string words_of(const decision& d) {
  std::string words = d.pair >= 0 ? "pair " + std::to_string(d.pair + 1) + ": " : "";
  words +=
      "IF (" + std::string(branch_conditions[index_of(d.what)]) + ") was " + (d.outcome ? "true" : "false");
  if (d.ulps == beyond_count) return words + ", with NaN";
  if (d.ulps == 0) return words + ", exactly on the threshold";
  return words + " by " + std::to_string(d.ulps) + " ULP";
}

template std::vector<decision> decisions_of(const call<float>&, std::span<const int>);
template std::vector<decision> decisions_of(const call<double>&, std::span<const int>);

}  // namespace contct::compare
