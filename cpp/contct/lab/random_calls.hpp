// Random and adversarial calls of CONTCT, each a function of a seed and its number.
#pragma once

#include <cstdint>

#include "contct/kernel/call_inputs.hpp"
#include "contct/numeric/random.hpp"

namespace contct::lab {

/// What both generators share: the arrays of a call, and the random numbers that it is drawn from.
template <class Real>
class drawn_calls {
 protected:
  explicit drawn_calls(std::uint64_t seed) : seed_(seed), random_(seed) {}

  /// Start call `number` with random numbers of its own, and overwrite with NaN what the call before left in
  /// dd and dtest: no kernel may read there.
  void begin(std::uint64_t number);
  /// Draw INDOF and NDOFPN, from 1 to 3 each.
  void draw_layout();
  void resize(int pairs);
  void draw_status_and_side(std::size_t i);

  std::uint64_t seed_;
  random_numbers random_;
  call_inputs<Real> in_;
};

/// Calls that reach every branch of the listing: 1 to 64 pairs, several of them on one node, every (INDOF,
/// NDOFPN) from (1, 1) to (3, 3), nodes beyond 999 now and then. Half of the numbers lie on a
/// coarse grid, so that ties, closed gaps and stationary pairs are common; others are scaled by
/// powers of ten from 1e-15 to 1e5.
template <class Real>
class random_calls : drawn_calls<Real> {
 public:
  explicit random_calls(std::uint64_t seed) : drawn_calls<Real>(seed) {}

  /// The next call; the reference is good until the one after.
  const call_inputs<Real>& next();

  /// Call `number`, a function of it and the seed alone.
  const call_inputs<Real>& at(std::uint64_t number);

 private:
  using drawn_calls<Real>::random_;
  using drawn_calls<Real>::in_;
  Real number(double zero_share, double grid_share);
  void place_pair(std::size_t i, int first_node, int nodes);
};

/// Calls made against the listing. Every pair is made for one of its decisions: a response of either zero or
/// the smallest number; a gap of EPSGAP; a response that makes SSCHK zero, subnormal or infinite; a scale
/// factor that ties with the winner's, is within EPSMUL of it, or is 1 (the mark for "no event") or 256/257,
/// where that mark is within EPSMUL: all exactly, or one or two ULP to either side; or numbers from the ends
/// of the floating-point range: zeros, subnormals, the largest, infinities, NaN. Now and then there are many
/// pairs, and invalid statuses.
template <class Real>
class adversarial_calls : drawn_calls<Real> {
 public:
  explicit adversarial_calls(std::uint64_t seed) : drawn_calls<Real>(seed) {}

  /// Call `number`, a function of it and the seed alone; the reference is good until the one after.
  const call_inputs<Real>& at(std::uint64_t number);

 private:
  using drawn_calls<Real>::random_;
  using drawn_calls<Real>::in_;
  void draw_scale_factor();
  void place_pair(std::size_t i);
  /// `x`, or a number one or two ULP to either side.
  Real nudged(Real x);
  Real from_the_edges();
  Real some_response();
  void place_gap(std::size_t dof, std::size_t i, Real gap);

  Real s_ = 0;  // the scale factor that this call's ties are about
};

/// The calls of a campaign: odd numbers are random, even ones adversarial.
class call_source {
 public:
  /// `real_bytes`: 8, or 4 for numbers and thresholds of single precision.
  call_source(std::uint64_t seed, int real_bytes);
  /// Call `number`, from 1; the reference is good until the one after.
  const call_inputs<double>& at(std::uint64_t number);

 private:
  int real_bytes_;
  random_calls<double> random_r8_;
  adversarial_calls<double> adversarial_r8_;
  random_calls<float> random_r4_;
  adversarial_calls<float> adversarial_r4_;
  call_inputs<double> wide_;
};

extern template class drawn_calls<float>;
extern template class drawn_calls<double>;
extern template class random_calls<float>;
extern template class random_calls<double>;
extern template class adversarial_calls<float>;
extern template class adversarial_calls<double>;

}  // namespace contct::lab
