// Which way the listing's IFs went: the floor under every comparison.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "contct/kernel/call.hpp"

namespace contct {

/// The IFs of the listing, in its order; the compound IF of the DO 10 loop counts twice.
enum class branch {
  no_response,     ///< IF (DTEST(NDOF).EQ.0.)
  stationary,      ///< ELSE IF (ABS(GAP).LT.EPSGAP)
  check_positive,  ///< IF (SSCHK.GT.0.)
  s_positive,      ///< IF (SS(I).GT.0. ...
  s_is_smallest,   ///< ... .AND. SS(I).LT.SMIN), where SS(I) is positive
  no_events,       ///< IF (SMIN.EQ.1.)
  within_epsmul,   ///< IF (DIFF.LT.EPSMUL)
  was_separated,   ///< IF (ISEP(I).EQ.1)
};

inline constexpr std::array<std::string_view, 8> branch_names = {
    "no_response",   "stationary", "check_positive", "s_positive",
    "s_is_smallest", "no_events",  "within_epsmul",  "was_separated"};

/// How often each IF was true and false, worked out from what went into and came out of calls.
/// This derives the decisions from the listing's text and shares no code with either kernel.
class branch_counts {
 public:
  /// Count one finished call: `c` with its outputs, `isep_before` as it went in.
  template <class Real>
  void count(const call<Real>& c, std::span<const int> isep_before);

  [[nodiscard]] std::int64_t of(branch b, bool outcome) const {
    return counts_[static_cast<std::size_t>(b)][outcome ? 1 : 0];
  }
  /// The rarest outcome's count: 0 means that some outcome of some IF was never reached.
  [[nodiscard]] std::int64_t rarest() const;

 private:
  bool note(branch b, bool outcome) {
    ++counts_[static_cast<std::size_t>(b)][outcome ? 1 : 0];
    return outcome;
  }

  std::array<std::array<std::int64_t, 2>, 8> counts_{};
};

extern template void branch_counts::count(const call<float>&, std::span<const int>);
extern template void branch_counts::count(const call<double>&, std::span<const int>);

}  // namespace contct
