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

double largest_response(const call<double>& c) {
  std::array<double, chains> largest{};
  const auto look_at = [&](double& so_far, std::size_t i) {
    const double response = std::abs(c.dtest[place(c, i)]);
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
void find_scale_factors(call<double>& c) {
  const double largest = largest_response(c);
  const std::size_t nc = c.cc.size();
  for (std::size_t i = 0; i < nc; ++i) {
    const std::size_t at = place(c, i);
    c.ss[i] = corrected_scale_factor(c.dd[at], c.dtest[at], c.cc[i], c.isep[i], c.isurf[i], largest);
  }
  std::array<double, chains> least = {1.0, 1.0, 1.0, 1.0};
  std::size_t i = 0;
  for (; i + chains <= nc; i += chains)
    for (std::size_t j = 0; j < chains; ++j) least[j] = c.ss[i + j] < least[j] ? c.ss[i + j] : least[j];
  for (; i < nc; ++i) least[0] = std::min(least[0], c.ss[i]);
  c.smin = *std::min_element(least.begin(), least.end());
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
  find_scale_factors(c);
  if (c.smin == 1.0) return {};
  const auto chosen =
      c.smin == 0.0 ? strongest_at_face(c, at_rest >= patience(c.nc()))
                    : static_cast<std::size_t>(std::find(c.ss.begin(), c.ss.end(), c.smin) - c.ss.begin());
  const bool makes = c.isep[chosen] == separated;
  c.isep[chosen] = makes ? in_contact : separated;
  return event{static_cast<int>(chosen), makes ? change::make : change::break_};
}

}  // namespace contct
