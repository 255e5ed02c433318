#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "contct/kernel/contct.hpp"

// On x86, a call uses the widest vectors of the processor. All widths give equal bits, because lanes are
// separate IEEE operations. Off with sanitizers, which are not ready when the loader chooses the function.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CONTCT_WIDEST_VECTORS [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define CONTCT_WIDEST_VECTORS
#endif

namespace contct {
namespace {

/// The threshold theta of the corrected rule, as a share of the largest response |d*| of all pairs. A smaller
/// response of a separated pair towards its face counts as rounding, and gives no event. An ignored make
/// costs an error of this share in position. An ignored break would leave a wrong force, so pairs in contact
/// have no threshold.
constexpr double quiet_share = 1e-10;

/// Returns the largest or the smallest, as `take` selects, of `start` and number(0) to number(n - 1). Eight
/// independent chains are faster than one.
template <class Number, class Take>
[[gnu::always_inline]] inline double folded(std::size_t n, double start, Number number, Take take) {
  std::array<double, 8> chains{};
  chains.fill(start);
  std::size_t i = 0;
  for (; i + chains.size() <= n; i += chains.size())
    for (std::size_t k = 0; k < chains.size(); ++k) chains[k] = take(chains[k], number(i + k));
  for (; i < n; ++i) chains[0] = take(chains[0], number(i));
  for (const double chain : chains) start = take(start, chain);
  return start;
}

/// Rules 1 and 2 of reference/corrected-rule.md: sets s of each pair, or 1 if no event is ahead. `dof(i)` is
/// the dof of pair i, from 0. The divisions for all pairs are in a loop without branches, because the
/// compiler vectorises such a loop, and an unneeded division costs less than a mispredicted branch.
template <class Dof>
[[gnu::always_inline]] inline void find_scale_factors(call<double>& c, Dof dof) {
  const std::size_t nc = c.cc.size();
  const double* const dd = c.dd.data();
  const double* const dtest = c.dtest.data();
  const double* const cc = c.cc.data();
  const int* const isep = c.isep.data();
  const int* const isurf = c.isurf.data();
  double* const ss = c.ss.data();
  const auto size_of_response = [&](std::size_t i) { return std::abs(dtest[dof(i)]); };
  const double m = folded(nc, 0.0, size_of_response, [](double a, double b) { return std::max(a, b); });
  for (std::size_t i = 0; i < nc; ++i) {
    const double sigma_n = static_cast<double>(isep[i]) * isurf[i];
    const double gap = sigma_n * (cc[i] - dd[dof(i)]);
    ss[i] = (gap > 0.0 ? gap : 0.0) / (sigma_n * dtest[dof(i)]);
  }
  const double quiet = quiet_share * m;
  for (std::size_t i = 0; i < nc; ++i) {
    const double sigma_v = static_cast<double>(isep[i]) * isurf[i] * dtest[dof(i)];
    const double theta = isep[i] == separated ? quiet : 0.0;
    const double s = ss[i] > 1.0 ? 1.0 : ss[i];
    ss[i] = sigma_v > theta ? s : 1.0;
  }
}

/// The dof of pair `i`, from 0.
std::size_t dof_at(const call<double>& c, std::size_t i) {
  return c.dof.dof_of(c.id[i]) - 1;
}

/// True if the dof of each pair is the pair's number, as on a path, which passes only the pairs' D and d*.
[[gnu::always_inline]] inline bool are_in_order(const call<double>& c) {
  int differs = (c.dof.indof - 1) | (c.dof.ndofpn - 1);
  for (std::size_t i = 0; i < c.id.size(); ++i) differs |= (c.id[i] - 1) ^ static_cast<int>(i);
  return differs == 0;
}

}  // namespace

CONTCT_WIDEST_VECTORS void contct_corrected(call<double>& c) noexcept {
  if (are_in_order(c)) {
    find_scale_factors(c, [](std::size_t i) { return i; });
  } else {
    find_scale_factors(c, [&c](std::size_t i) { return dof_at(c, i); });
  }
  const double* const ss = c.ss.data();
  const auto s = [ss](std::size_t i) { return ss[i]; };
  c.smin = folded(c.cc.size(), 1.0, s, [](double a, double b) { return std::min(a, b); });
  if (c.smin == 1.0) return;

  // Rules 3 and 4: choose the first pair at SMIN or, if SMIN = 0, the pair at its face with the largest |d*|.
  const auto size_of_response = [&c](std::size_t i) { return std::abs(c.dtest[dof_at(c, i)]); };
  const bool by_index = c.smin > 0.0;
  std::size_t chosen = c.cc.size();
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    if (ss[i] != c.smin) continue;
    if (chosen == c.cc.size() || (!by_index && size_of_response(i) > size_of_response(chosen))) chosen = i;
    if (by_index) break;
  }
  c.isep[chosen] = c.isep[chosen] == separated ? in_contact : separated;
}

}  // namespace contct
