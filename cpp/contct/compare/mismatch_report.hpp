// A divergence told: which call, which kernel, which number, and how narrowly the listing decided there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contct/compare/compare.hpp"
#include "contct/compare/margin.hpp"

namespace contct {

/// The first call in which a follower did not answer as the leader.
struct mismatch_report {
  std::int64_t call = 0;  ///< from 1
  std::string leader;     ///< names of the kernels
  std::string follower;
  mismatch where;
  std::vector<decision> decisions;  ///< of the leader in that call
};

/// Two lines: "call 7: mine differs in SS(3): fortran has 0x1p-1, mine has 0x1p-2 (4503599627370496 ULP)",
/// and its branch margin.
[[nodiscard]] std::vector<std::string> words_of(const mismatch_report& f);

/// The branch margin: the narrowest decision of the call, and what follows from it.
[[nodiscard]] std::string margin_words(const mismatch_report& f);

}  // namespace contct
