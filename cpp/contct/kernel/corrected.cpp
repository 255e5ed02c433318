#include "contct/kernel/corrected.hpp"

#include <array>

namespace contct {
namespace {

// Reductions of thousands of numbers wait for each other when they are one chain: four chains wait a quarter.
constexpr std::size_t chains = 4;

/// The dof of pair `i`, from 0.
std::size_t place(const call<double>& c, std::size_t i) {
  return static_cast<std::size_t>(c.dof.dof_of(c.id[i]) - 1);
}

/// Has pair 1 the first dof, pair 2 the second, and so on? Then nothing need be looked up.
bool in_order(const call<double>& c) {
  if (c.dof.indof != 1 || c.dof.ndofpn != 1) return false;
  int off = 0;
  for (std::size_t i = 0; i < c.id.size(); ++i) off |= c.id[i] ^ static_cast<int>(i + 1);
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

/// Two pairs side by side: the compiler divides both at once.
using two = double __attribute__((vector_size(16)));

/// s of every pair, and the least of them.
template <class At>
void find_scale_factors(call<double>& c, At at) {
  const double largest = largest_response(c, at);
  const double quiet = quiet_share * largest;
  const auto of_two = [&](std::size_t i) {
    const std::size_t k = i + 1;
    const two i_sep = {double(c.isep[i]), double(c.isep[k])};
    const two threshold = i_sep == double{separated} ? two{quiet, quiet} : two{};
    return corrected_scale_factor(two{c.dd[at(i)], c.dd[at(k)]}, two{c.dtest[at(i)], c.dtest[at(k)]},
                                  two{c.cc[i], c.cc[k]}, i_sep * two{double(c.isurf[i]), double(c.isurf[k])},
                                  threshold);
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
    c.ss[i] = corrected_scale_factor(c.dd[at(i)], c.dtest[at(i)], c.cc[i],
                                     static_cast<double>(c.isep[i] * c.isurf[i]),
                                     c.isep[i] == separated ? quiet : 0.0);
    c.smin = std::min(c.smin, c.ss[i]);
  }
}

/// The pair at its face with the largest |d*|, or the first of all.
std::size_t strongest_at_face(const call<double>& c, bool by_index) {
  std::size_t chosen = c.cc.size();
  double response = 0.0;
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    if (c.ss[i] != 0.0 || !(std::abs(c.dtest[place(c, i)]) > response)) continue;
    chosen = i;
    if (by_index) break;
    response = std::abs(c.dtest[place(c, i)]);
  }
  return chosen;
}

}  // namespace

std::optional<event> contct_corrected(call<double>& c, int at_rest) noexcept {
  if (in_order(c)) {
    find_scale_factors(c, [](std::size_t i) { return i; });
  } else {
    find_scale_factors(c, [&c](std::size_t i) { return place(c, i); });
  }
  if (c.smin == 1.0) return {};
  const auto chosen =
      c.smin == 0.0 ? strongest_at_face(c, at_rest >= patience(c.nc()))
                    : static_cast<std::size_t>(std::find(c.ss.begin(), c.ss.end(), c.smin) - c.ss.begin());
  const bool makes = c.isep[chosen] == separated;
  c.isep[chosen] = makes ? in_contact : separated;
  return event{static_cast<int>(chosen), makes ? change::make : change::break_};
}

}  // namespace contct
