#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contct/kernel/contct_quick.hpp"
#include "contct/kernel/corrected.hpp"

namespace contct::kernels {
namespace {

double response(const call<double>& c, std::size_t i) {
  return c.dtest[c.dof.dof_of(c.id[i]) - 1];
}

/// s of every pair, and the first that has the least of them.
least_s find_scale_factors(call<double>& c, const wide_scan& scan) {
  const pair_arrays a = arrays_of(c, scan);
  double m = scan.largest_response(a);
  for (std::size_t i = scan.whole(a.n); i < a.n; ++i) m = std::max(m, std::abs(response(c, i)));
  least_s least = scan.corrected(a, quiet_share * m);
  for (std::size_t i = scan.whole(a.n); i < a.n; ++i) {
    c.ss[i] = corrected_scale_factor(c, i, m);
    if (c.ss[i] < least.s) least = {c.ss[i], i};
  }
  return least;
}

/// Rule 4 of the pairs with s = 0, of which `first` is the first: the one with the largest |d*|.
std::size_t chosen_at_face(const call<double>& c, std::size_t first) {
  std::size_t chosen = first;
  for (std::size_t i = first + 1; i < c.cc.size(); ++i)
    if (c.ss[i] == 0.0 && std::abs(response(c, i)) > std::abs(response(c, chosen))) chosen = i;
  return chosen;
}

}  // namespace

void contct_corrected_quick(call<double>& c, const wide_scan& scan) noexcept {
  const least_s least = find_scale_factors(c, scan);
  c.smin = least.s;
  if (c.smin == 1.0) return;
  const bool by_index = c.smin > 0.0 || c.at_rest >= quick_answers_at_rest(c.nc());
  const std::size_t chosen = by_index ? least.pair : chosen_at_face(c, least.pair);
  c.isep[chosen] = c.isep[chosen] == separated ? in_contact : separated;
}

}  // namespace contct::kernels
