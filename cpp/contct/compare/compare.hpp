// Tier 1: are two answers to one call equal to the bit?
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "contct/kernel/kernel.hpp"
#include "contct/numeric/bits.hpp"

namespace contct::compare {

/// What a kernel gives back, as far as it is compared.
template <class Real>
struct answer {
  Real smin;
  std::span<const Real> ss;
  std::span<const int> isep;
};

/// Where two answers differ first: SMIN, then SS, then ISEP, then the text.
struct mismatch {
  std::string field;       ///< "SMIN", "SS", "ISEP" or "text"
  int index = 0;           ///< pair, from 1, for SS and ISEP; line, from 1, for the text; else 0
  std::string leader;      ///< the leader's value, numbers in hexfloat
  std::string follower;    ///< the follower's
  std::uint64_t ulps = 0;  ///< distance of two numbers; 0 for ISEP and the text
};

/// How many values have been compared, and how many of them differed.
struct tally {
  std::int64_t values = 0;
  std::int64_t mismatches = 0;

  tally& operator+=(const tally& other) {
    values += other.values;
    mismatches += other.mismatches;
    return *this;
  }
};

/// Compare two answers of equal length, value by value. NaN equals NaN; -0.0 is not +0.0.
template <class Real>
std::optional<mismatch> compare_answers(const answer<Real>& leader, const answer<Real>& follower, tally& t) {
  std::optional<mismatch> first;
  const auto differ = [&](std::string field, std::size_t index, std::string a, std::string b,
                          std::uint64_t ulps) {
    ++t.mismatches;
    if (!first) first = mismatch{std::move(field), static_cast<int>(index), std::move(a), std::move(b), ulps};
  };
  const auto real = [&](const char* field, std::size_t index, Real a, Real b) {
    if (!same_bits(a, b)) differ(field, index, hexfloat(a), hexfloat(b), ulps_between(a, b));
  };
  real("SMIN", 0, leader.smin, follower.smin);
  for (std::size_t i = 0; i < leader.ss.size(); ++i) real("SS", i + 1, leader.ss[i], follower.ss[i]);
  for (std::size_t i = 0; i < leader.isep.size(); ++i) {
    if (leader.isep[i] != follower.isep[i]) {
      differ("ISEP", i + 1, std::to_string(leader.isep[i]), std::to_string(follower.isep[i]), 0);
    }
  }
  t.values += 1 + static_cast<std::int64_t>(leader.ss.size() + leader.isep.size());
  return first;
}

/// How unit-26 text is compared.
enum class text_equality {
  bytes,   ///< byte for byte
  meaning  ///< word by word, line by line; .25 is 0.25: libf2c leaves that zero out
};

/// Compare unit-26 text, as one value.
std::optional<mismatch> compare_text(std::string_view leader, std::string_view follower, tally& t,
                                     text_equality equality = text_equality::bytes);

/// How the text of two kernels is compared.
[[nodiscard]] text_equality text_equality_of(const kernel_facts& leader, const kernel_facts& follower);

}  // namespace contct::compare
