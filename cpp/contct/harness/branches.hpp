// Derives from a finished call the outcome of each IF of the listing, and its margin: the distance of the two
// numbers that the IF compares. If two kernels differ after an IF with a small margin, rounding can be the
// cause (a tie); after a large margin the cause is a bug.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

/// The numbers from which the listing computes SS of one pair.
template <class Real>
struct pair_numbers {
  // From the listing's DATA; kernel/contct.hpp is not used, so that an error in its constants is found.
  static constexpr Real delta = sizeof(Real) == 4 ? static_cast<Real>(1.E-20F) : static_cast<Real>(1.E-20);
  static constexpr Real epsgap = sizeof(Real) == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);
  static constexpr Real epsmul = Real(1) / Real(256);

  /// The numbers of pair `i` with ISEP `status`, if its dof is `dof` (from 0). D and d* are NaN if the call
  /// has no such dof.
  pair_numbers(const call<Real>& c, int status, std::size_t i, std::int64_t dof)
      : d(value_at(c.dd, dof)),
        d_star(value_at(c.dtest, dof)),
        gap(c.cc[i] - d),
        is_stationary(std::abs(gap) < epsgap),
        sschk(static_cast<Real>(status * c.isurf[i]) / d_star),
        event(sschk * delta),
        at_face(sschk > Real(0) ? event : Real(1)),
        moving(gap / d_star),
        without_first(is_stationary ? at_face : moving),
        s(d_star != Real(0) ? without_first : Real(1)) {}
  pair_numbers(const call<Real>& c, std::span<const int> isep_before, std::size_t i)
      : pair_numbers(c, isep_before[i], i, c.dof.dof_of(c.id[i]) - 1) {}

  Real d, d_star, gap;
  bool is_stationary = false;
  Real sschk, event;
  // s of a stationary pair; s of a moving pair; s without IF (DTEST(NDOF).EQ.0.); s
  Real at_face, moving, without_first, s;

 private:
  template <class Values>
  static Real value_at(const Values& values, std::int64_t dof) {
    const bool is_there = dof >= 0 && dof < std::ssize(values);
    return is_there ? values[dof] : std::numeric_limits<Real>::quiet_NaN();
  }
};

/// Calls visit(branch, pair from 0, outcome, left, right) for each decision of a finished call; the IF
/// compares `left` with `right`. `c` contains the outputs, `isep_before` the ISEP before the call. This
/// function follows the listing's text and shares no code with a kernel.
template <class Real, class Visit>
void for_each_decision(const call<Real>& c, std::span<const int> isep_before, Visit visit) {
  using numbers = pair_numbers<Real>;
  const Real zero = 0;
  Real smin = 1;
  const auto decide = [&visit](branch b, std::size_t i, bool outcome, Real left, Real right) {
    visit(b, i, outcome, left, right);
    return outcome;
  };
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    const numbers p(c, isep_before, i);
    if (!decide(branch::no_response, i, p.d_star == zero, p.d_star, zero) &&
        decide(branch::stationary, i, p.is_stationary, std::abs(p.gap), numbers::epsgap))
      decide(branch::check_positive, i, p.sschk > zero, p.sschk, zero);
    const Real s = c.ss[i];
    if (decide(branch::s_positive, i, s > zero, s, zero) &&
        decide(branch::s_is_smallest, i, s < smin, s, smin))
      smin = s;
  }
  if (decide(branch::no_events, 0, c.smin == Real(1), c.smin, Real(1))) return;
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    const Real diff = std::abs(c.ss[i] - c.smin) / c.smin;
    if (decide(branch::within_epsmul, i, diff < numbers::epsmul, diff, numbers::epsmul)) {
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
  [[nodiscard]] std::int64_t rarest() const { return *std::ranges::min_element(counts_); }

 private:
  std::array<std::int64_t, 16> counts_{};  // [2 * branch + outcome]
};

/// The distance in ULP of two compared numbers: 0 from -0.0 to +0.0; the largest std::uint64_t if one is NaN.
template <class Real>
[[nodiscard]] std::uint64_t margin_between(Real a, Real b) {
  return ulps_between(a == Real(0) ? Real(0) : a, b == Real(0) ? Real(0) : b);
}

/// The value of decision::ulps for IF (ISEP(I).EQ.1), which compares integers and has no margin.
inline constexpr std::uint64_t whole_numbers = std::numeric_limits<std::uint64_t>::max() - 1;

/// The outcome of an IF in a call, and its margin.
struct decision {
  template <class Real>
  decision(branch b, std::size_t i, bool was_true, Real left, Real right)
      : what(b),
        pair(b == branch::no_events ? -1 : static_cast<int>(i)),
        outcome(was_true),
        ulps(b == branch::was_separated ? whole_numbers : margin_between(left, right)) {}

  branch what;
  int pair;  ///< from 0; -1 for IF (SMIN.EQ.1.)
  bool outcome;
  std::uint64_t ulps;  ///< the margin, see margin_between; 0: exactly on the threshold
};

/// Replaces `least` by `d` if the margin of `d` is smaller, or if `least` is empty.
inline void keep_narrower(std::optional<decision>& least, const decision& d) {
  if (!least || d.ulps < least->ulps) least = d;
}

/// For example "pair 3: IF (DIFF.LT.EPSMUL) was false by 1 ULP".
[[nodiscard]] std::string words_of(const decision& d);

/// The largest margin [ULP] at which the rounding of one or two operations can change a decision.
inline constexpr std::uint64_t tie_ulps = 4;

}  // namespace contct
