// How narrowly the listing decided: a mismatch at a narrow decision is a tie, elsewhere a bug.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/compare/branches.hpp"
#include "contct/numeric/bits.hpp"

namespace contct::compare {

/// How many numbers lie between the two that an IF compares. The two zeros compare equal: none lies between
/// them. The largest count there is where one of them is NaN.
template <class Real>
[[nodiscard]] std::uint64_t margin_between(Real a, Real b) {
  return ulps_between(a == Real(0) ? Real(0) : a, b == Real(0) ? Real(0) : b);
}

/// `then(call<float>)` with the call of a 4-byte kernel, which comes in double precision, rounded as the
/// kernel rounds it.
template <class Then>
auto as_float_call(const call<double>& c, Then then) {
  const auto rounded = [](std::span<const double> x) { return std::vector<float>(x.begin(), x.end()); };
  const std::vector<float> dd = rounded(c.dd);
  const std::vector<float> dtest = rounded(c.dtest);
  const std::vector<float> cc = rounded(c.cc);
  std::vector<float> ss = rounded(c.ss);
  return then(call<float>{dd, dtest, cc, ss, static_cast<float>(c.smin), c.id, c.isep, c.isurf, c.dof});
}

/// One decision of one call, and by how much it was taken.
struct decision {
  branch what;
  int pair;  ///< from 0; -1 for IF (SMIN.EQ.1.)
  bool outcome;
  std::uint64_t ulps;  ///< numbers between the two that were compared; 0: on the threshold. The largest
                       ///< there is where one of them is NaN
};

/// All decisions of a finished call, in the listing's order. IF (ISEP(I).EQ.1) compares whole numbers
/// and has no margin: it is left out.
template <class Real>
[[nodiscard]] std::vector<decision> decisions_of(const call<Real>& c, std::span<const int> isep_before);

/// The same for a kernel of `real_bytes`, whose call comes in double precision.
[[nodiscard]] std::vector<decision> decisions_of(const call<double>& c, std::span<const int> isep_before,
                                                 int real_bytes);

/// The decision that was taken by least; none when there was none.
[[nodiscard]] std::optional<decision> narrowest(const std::vector<decision>& all);

/// "pair 3: IF (DIFF.LT.EPSMUL) was false by 1 ULP".
[[nodiscard]] std::string words_of(const decision& d);

/// A decision taken by at most this many ULP is within the rounding of one or two operations.
inline constexpr std::uint64_t tie_ulps = 4;

}  // namespace contct::compare
