// Derives from a finished call the outcome of each IF of the listing, and its margin: the distance of the two
// numbers that the IF compares. If two kernels differ after an IF with a small margin, rounding can be the
// cause (a tie); after a large margin the cause is a bug.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "contct/kernel/call.hpp"
#include "contct/number/bits.hpp"

namespace contct {

/// The IFs of the listing, in its order; the compound IF of the DO 10 loop counts as two.
enum class branch {
  no_response,     ///< IF (DTEST(NDOF).EQ.0.)
  stationary,      ///< ELSE IF (ABS(GAP).LT.EPSGAP)
  check_positive,  ///< IF (SSCHK.GT.0.)
  s_positive,      ///< IF (SS(I).GT.0. ...
  s_is_smallest,   ///< ... .AND. SS(I).LT.SMIN), if SS(I) is positive
  no_events,       ///< IF (SMIN.EQ.1.)
  within_epsmul,   ///< IF (DIFF.LT.EPSMUL)
  was_separated,   ///< IF (ISEP(I).EQ.1)
};

/// The index of a branch in the two arrays below.
[[nodiscard]] constexpr std::size_t index_of(branch b) {
  return static_cast<std::size_t>(b);
}

inline constexpr std::array<std::string_view, 8> branch_names = {
    "no_response",   "stationary", "check_positive", "s_positive",
    "s_is_smallest", "no_events",  "within_epsmul",  "was_separated"};

/// The IFs as the listing prints them.
inline constexpr std::array<std::string_view, 8> branch_conditions = {
    "DTEST(NDOF).EQ.0.", "ABS(GAP).LT.EPSGAP", "SSCHK.GT.0.",    "SS(I).GT.0.",
    "SS(I).LT.SMIN",     "SMIN.EQ.1.",         "DIFF.LT.EPSMUL", "ISEP(I).EQ.1"};

/// Calls visit(branch, pair from 0, outcome, left, right) for each decision of a finished call; the IF
/// compares `left` with `right`. `c` contains the outputs, `isep_before` the ISEP before the call. This
/// function follows the listing's text and shares no code with a kernel.
template <class Real, class Visit>
void for_each_decision(const call<Real>& c, std::span<const int> isep_before, Visit visit) {
  // From the listing's DATA; kernel/contct.hpp is not used, so that an error in its constants is found.
  const Real epsgap = sizeof(Real) == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);
  const Real epsmul = Real(1) / Real(256);
  const Real zero = 0;
  Real smin = 1;
  const auto decide = [&visit](branch b, std::size_t i, bool outcome, Real left, Real right) {
    visit(b, i, outcome, left, right);
    return outcome;
  };
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    const int ndof = (c.id[i] - 1) * c.dof.ndofpn + c.dof.indof - 1;
    const Real dtest = c.dtest[ndof];
    const Real gap = std::abs(c.cc[i] - c.dd[ndof]);
    if (!decide(branch::no_response, i, dtest == zero, dtest, zero) &&
        decide(branch::stationary, i, gap < epsgap, gap, epsgap)) {
      const Real sschk = static_cast<Real>(isep_before[i] * c.isurf[i]) / dtest;
      decide(branch::check_positive, i, sschk > zero, sschk, zero);
    }
    const Real s = c.ss[i];
    if (decide(branch::s_positive, i, s > zero, s, zero) &&
        decide(branch::s_is_smallest, i, s < smin, s, smin))
      smin = s;
  }
  if (decide(branch::no_events, 0, c.smin == Real(1), c.smin, Real(1))) return;
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    const Real diff = std::abs(c.ss[i] - c.smin) / c.smin;
    if (decide(branch::within_epsmul, i, diff < epsmul, diff, epsmul)) {
      const auto status = static_cast<Real>(isep_before[i]);
      decide(branch::was_separated, i, isep_before[i] == separated, status, static_cast<Real>(separated));
    }
  }
}

/// How often each IF was true and false, derived from the inputs and outputs of calls.
class branch_counts {
 public:
  /// Counts the decisions of a finished call. Arguments: see for_each_decision.
  template <class Real>
  void count(const call<Real>& c, std::span<const int> isep_before) {
    for_each_decision(c, isep_before,
                      [this](branch b, std::size_t, bool outcome, Real, Real) { ++of(b, outcome); });
  }

  [[nodiscard]] std::int64_t& of(branch b, bool outcome) {
    return counts_[2 * index_of(b) + (outcome ? 1 : 0)];
  }
  [[nodiscard]] std::int64_t of(branch b, bool outcome) const {
    return counts_[2 * index_of(b) + (outcome ? 1 : 0)];
  }
  /// The count of the rarest outcome; 0 if any outcome of any IF never occurred.
  [[nodiscard]] std::int64_t rarest() const;
  void add(const branch_counts& other);

 private:
  std::array<std::int64_t, 16> counts_{};  // [2 * branch + outcome]
};

/// The distance in ULP of two compared numbers: 0 from -0.0 to +0.0; the largest std::uint64_t if one is NaN.
template <class Real>
[[nodiscard]] std::uint64_t margin_between(Real a, Real b) {
  return ulps_between(a == Real(0) ? Real(0) : a, b == Real(0) ? Real(0) : b);
}

/// The outcome of an IF in a call, and its margin.
struct decision {
  branch what;
  int pair;  ///< from 0; -1 for IF (SMIN.EQ.1.)
  bool outcome;
  std::uint64_t ulps;  ///< the margin, see margin_between; 0: exactly on the threshold
};

/// The value of decision::ulps for IF (ISEP(I).EQ.1), which compares integers and has no margin.
inline constexpr std::uint64_t whole_numbers = std::numeric_limits<std::uint64_t>::max() - 1;

/// Replaces `least` by the decision of `b` if its margin `ulps` is smaller, or if `least` is empty. Ignores
/// IF (ISEP(I).EQ.1), which has no margin.
inline void keep_narrower(std::optional<decision>& least, branch b, std::size_t pair, bool outcome,
                          std::uint64_t ulps) {
  if (b == branch::was_separated || (least && least->ulps <= ulps)) return;
  least = decision{b, b == branch::no_events ? -1 : static_cast<int>(pair), outcome, ulps};
}

/// Returns the decision with the smallest margin among those for which counts(branch, pair from 0) is true.
/// Returns IF (ISEP(I).EQ.1) only if no other IF counts, and nothing if no IF counts.
[[nodiscard]] std::optional<decision> narrowest_decision(
    const answered_call& c, int real_bytes, const std::function<bool(branch, std::size_t)>& counts);

/// For example "pair 3: IF (DIFF.LT.EPSMUL) was false by 1 ULP".
[[nodiscard]] std::string words_of(const decision& d);

/// The largest margin [ULP] at which the rounding of one or two operations can change a decision.
inline constexpr std::uint64_t tie_ulps = 4;

}  // namespace contct
