// How a state is corrected by its residual in 32 digits, until only the last digits are left.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/certify/error_bounds.hpp"

namespace contct::certify {
namespace {

/// Displacements so small that products of them underflow become 0.
void flush_tiny(long_vector& u) {
  constexpr double none = 1e-140;
  for (double_double& x : u)
    if (std::abs(x.hi) < none) x = 0.0;
}

}  // namespace

/// The residual if the pairs of `closed` pressed or pulled by their springs, and no others: that is linear in
/// u.
long_vector error_prover::residual_of_set(const residual& r, std::span<const double_double> u,
                                          const std::vector<int>& closed) const {
  long_vector force = r.force;
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const true_pair& p = true_.pairs[i];
    const double_double deep = depth(i, u);
    const bool is_closed = std::ranges::binary_search(closed, static_cast<int>(i));
    if (true_.fixed[p.dof] != 0 || is_closed == (deep.hi > 0.0)) continue;
    const double_double spring = p.stiffness * deep * p.surface;
    force[p.dof] += is_closed ? -spring : spring;
  }
  return force;
}

/// K_A^-1 r, and the square of r's norm.
double error_prover::correction_for(const long_vector& force, std::vector<double>& correction) const {
  double square = 0.0;
  for (std::size_t dof = 0; dof < force.size(); ++dof) correction[dof] = force[dof].hi;
  stiffness_.solve(correction);
  for (std::size_t dof = 0; dof < force.size(); ++dof) square += force[dof].hi * correction[dof];
  return square;
}

/// u += K_A^-1 r until r is nothing beside the loads, or that no longer makes it smaller; then the pairs that
/// are beyond their faces become A, as long as these are others. A stiff pair may be so less deep than a
/// correction is rounded, so A is kept until its own equations are solved. False where K_A is not definite
/// for certain. Keeps the residual.
bool error_prover::correct(const true_loads& l, long_vector& u) {
  constexpr int most = 40;
  constexpr double none = 0x1p-150;  // of the loads' work: displacements are right to 2^-75
  refined_step_ = 0;                 // what was kept of it is overwritten
  flush_tiny(u);
  std::vector<int> closed = pressed(u);
  long_vector best;
  double least = std::numeric_limits<double>::infinity();
  double before = least;  // with the same A
  std::vector<double> correction(u.size());
  for (int i = 0; i < most && proves(holding(u, closed)); ++i) {
    residual r = residual_of(u, l);
    const std::vector<int> now = pressed(u);
    double square = correction_for(r.force, correction);
    double work = 0.0;
    for (std::size_t dof = 0; dof < u.size(); ++dof) work += l.force[dof].hi * u[dof].hi;
    // Another A measures by another norm.
    if (best.empty() || (now == closed && (square < least || square == 0.0))) {
      best = u;
      residual_ = r;
      if (now == closed) least = square;
    }
    if (now != closed) square = correction_for(residual_of_set(r, u, closed), correction);
    const bool nothing = (square >= 0.0 && square <= none * work) ||
                         std::ranges::all_of(correction, [](double x) { return x == 0.0; });
    if (nothing || !(square < before)) {
      if (now == closed) break;
      closed = now;
      before = std::numeric_limits<double>::infinity();
      continue;
    }
    before = square;
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      if (true_.fixed[dof] == 0) u[dof] += correction[dof];
    flush_tiny(u);
  }
  if (best.empty()) return false;
  u = std::move(best);
  return true;
}

/// A pair whose force, or lack of it, cannot be rounding has the status that goes with it.
void error_prover::settle_statuses(std::span<const double_double> u, const true_loads& l,
                                   std::span<int> isep) const {
  double largest = 0.0;
  for (const double_double& f : l.force) largest = std::max(largest, std::abs(f.hi));
  for (std::size_t i = 0; i < true_.pairs.size(); ++i)
    largest = std::max(largest, true_.pairs[i].stiffness.hi * depth(i, u).hi);
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const double force = true_.pairs[i].stiffness.hi * depth(i, u).hi;
    if (std::abs(force) > 1e-12 * largest) isep[i] = force > 0.0 ? in_contact : separated;
  }
}

/// A pair that is certainly beyond its face, or off it, in all states within rho of u has the status that
/// goes with it.
void error_prover::settle_certain_statuses(std::span<const double_double> u, double rho,
                                           std::span<int> isep) const {
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const double deep = depth(i, u).hi;
    if (std::abs(deep) > reach_of_pair(i, u, rho)) isep[i] = deep > 0.0 ? in_contact : separated;
  }
}

/// Reactions and element forces that are no more than the rounding of 32 digits are 0.
end_numbers error_prover::numbers_of(std::span<const double_double> u, std::span<const int> isep) const {
  const auto told = [](const double_double& x, double noise) { return std::abs(x.hi) > noise ? x.hi : 0.0; };
  end_numbers n;
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const double_double deep = depth(i, u);
    const bool presses = isep[i] == in_contact && deep.hi > 0.0;
    n.pair_forces.push_back(presses ? (true_.pairs[i].stiffness * deep).hi : 0.0);
  }
  for (const true_reaction& r : reactions_at(u, residual_)) n.reactions.push_back(told(r.force, r.slack));
  for (const element_value& v : values_) n.element_values.push_back(told(v.value, noise_of(v)));
  return n;
}

std::optional<end_numbers> error_prover::refine(int step, std::span<double> displacement,
                                                std::span<int> isep) {
  const true_loads& l = loads_of(step);
  long_vector u = long_displacement(step, displacement, l);
  refined_bounds_.reset();
  if (is_unloaded(l) && proves({})) {
    std::fill(u.begin(), u.end(), 0.0);
    residual_ = residual_of(u, l);
  } else if (!correct(l, u)) {
    return std::nullopt;
  }
  refined_step_ = step;
  refined_ = u;
  values_ = true_.element_values(step, u);
  for (std::size_t dof = 0; dof < displacement.size(); ++dof) displacement[dof] = u[dof].hi;
  error_bounds b;
  if (find_closed(u, residual_, b)) {
    settle_certain_statuses(u, b.rho, isep);
    refined_bounds_ = b;
  } else {
    settle_statuses(u, l, isep);
  }
  return numbers_of(u, isep);
}

const true_loads& error_prover::loads_of(int step) {
  if (loads_.step != step) loads_ = true_.loads(step);
  return loads_;
}

}  // namespace contct::certify
