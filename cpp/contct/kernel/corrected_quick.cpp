#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "contct/kernel/corrected.hpp"

namespace contct::kernels {
namespace {

// A minimum or maximum over thousands of numbers is limited by latency: four chains take a quarter of the
// time.
constexpr std::size_t chains = 4;

/// Two pairs side by side: one instruction divides both.
using two = double __attribute__((vector_size(16)));

/// Rules 1 and 2 for one pair or for two, without a branch: `sigma_n` is i_sep n.
template <class Real>
Real scale_factor(Real d, Real d_star, Real c, Real sigma_n, Real theta) {
  const Real one = Real{} + 1.0;
  const Real sigma_v = sigma_n * d_star;
  const Real sigma_g = sigma_n * (c - d);
  const auto moves = sigma_v > theta;
  const Real s = (sigma_g > 0.0 ? sigma_g : Real{}) / (moves ? sigma_v : one);
  const Real within = s > 1.0 ? one : s;
  return moves ? within : one;
}

/// Has pair 1 the first dof, pair 2 the second, and so on? Then nothing need be looked up.
bool in_order(const call<double>& c) {
  if (c.dof.indof != 1 || c.dof.ndofpn != 1) return false;
  int off = 0;
  for (int i = 0; i < c.nc(); ++i) off |= c.id[i] ^ (i + 1);
  return off == 0;
}

/// `at(i)`: the dof of pair i.
template <class At>
double largest_response(const call<double>& c, At at) {
  std::array<double, chains> largest{};
  const auto look_at = [&](double& so_far, std::size_t i) {
    const double response = std::abs(c.dtest[at(i)]);
    so_far = so_far < response ? response : so_far;
  };
  const std::size_t nc = c.cc.size();
  std::size_t i = 0;
  for (; i + chains <= nc; i += chains)
    for (std::size_t j = 0; j < chains; ++j) look_at(largest[j], i + j);
  for (; i < nc; ++i) look_at(largest[0], i);
  return *std::max_element(largest.begin(), largest.end());
}

/// s of every pair, and the least of them.
template <class At>
void find_scale_factors(call<double>& c, At at) {
  const double quiet = quiet_share * largest_response(c, at);
  const auto of_two = [&](std::size_t i) {
    const std::size_t k = i + 1;
    const two i_sep = {double(c.isep[i]), double(c.isep[k])};
    const two theta = i_sep == double{separated} ? two{quiet, quiet} : two{};
    return scale_factor(two{c.dd[at(i)], c.dd[at(k)]}, two{c.dtest[at(i)], c.dtest[at(k)]},
                        two{c.cc[i], c.cc[k]}, i_sep * two{double(c.isurf[i]), double(c.isurf[k])}, theta);
  };
  const std::size_t nc = c.cc.size();
  std::array<two, chains / 2> least{};
  least.fill(two{1.0, 1.0});
  std::size_t i = 0;
  for (; i + chains <= nc; i += chains) {
    for (std::size_t j = 0; j < chains / 2; ++j) {
      const two s = of_two(i + 2 * j);
      c.ss[i + 2 * j] = s[0];
      c.ss[i + 2 * j + 1] = s[1];
      least[j] = s < least[j] ? s : least[j];
    }
  }
  c.smin = 1.0;
  for (const two& l : least) c.smin = std::min({c.smin, l[0], l[1]});
  for (; i < nc; ++i) {
    c.ss[i] = scale_factor(c.dd[at(i)], c.dtest[at(i)], c.cc[i], double(c.isep[i] * c.isurf[i]),
                           c.isep[i] == separated ? quiet : 0.0);
    c.smin = std::min(c.smin, c.ss[i]);
  }
}

/// Rule 4: of the pairs with s = 0 the first, or the one with the largest |d*|.
template <class At>
std::size_t chosen_at_face(const call<double>& c, At at) {
  std::size_t chosen = std::find(c.ss.begin(), c.ss.end(), 0.0) - c.ss.begin();
  if (c.at_rest >= quick_answers_at_rest(c.nc())) return chosen;
  for (std::size_t i = chosen + 1; i < c.cc.size(); ++i)
    if (c.ss[i] == 0.0 && std::abs(c.dtest[at(i)]) > std::abs(c.dtest[at(chosen)])) chosen = i;
  return chosen;
}

template <class At>
void answer(call<double>& c, At at) {
  find_scale_factors(c, at);
  if (c.smin == 1.0) return;
  const std::size_t chosen =
      c.smin == 0.0 ? chosen_at_face(c, at) : std::find(c.ss.begin(), c.ss.end(), c.smin) - c.ss.begin();
  c.isep[chosen] = c.isep[chosen] == separated ? in_contact : separated;
}

}  // namespace

void contct_corrected_quick(call<double>& c) noexcept {
  if (in_order(c)) {
    answer(c, [](std::size_t i) { return i; });
  } else {
    answer(c, [&c](std::size_t i) -> std::size_t { return c.dof.dof_of(c.id[i]) - 1; });
  }
}

}  // namespace contct::kernels
