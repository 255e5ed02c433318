#include "contct/lab/random_calls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contct/kernel/contct.hpp"

namespace contct::lab {
namespace {

constexpr int most_pairs = 64;
constexpr int last_node = 1100;  // beyond 999, I3 of the log overflows
constexpr int most_dofs = 3 * last_node + 3;
constexpr double powers_of_ten[] = {1e-15, 1e-12, 1e-10, 1e-9, 1e-6, 1e-3, 1.0, 1e2, 1e5};
constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15;  // so that the two generators do not run in step

}  // namespace

template <class Real>
void drawn_calls<Real>::begin(std::uint64_t number) {
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  for (std::size_t i = 0; i < in_.pairs(); ++i) {
    in_.dd[in_.dof_of_pair(i)] = nan;
    in_.dtest[in_.dof_of_pair(i)] = nan;
  }
  random_ = random_numbers(random_numbers(seed_ ^ (number * 0xd1342543de82ef95)).bits());
}

template <class Real>
void drawn_calls<Real>::draw_layout() {
  in_.dof = {random_.whole(1, 3), random_.whole(1, 3)};
  if (!in_.dd.empty()) return;
  in_.dd.assign(most_dofs, std::numeric_limits<Real>::quiet_NaN());
  in_.dtest = in_.dd;
}

template <class Real>
void drawn_calls<Real>::resize(int pairs) {
  in_.cc.resize(pairs);
  for (auto* list : {&in_.id, &in_.isep, &in_.isurf}) list->resize(pairs);
}

template <class Real>
void drawn_calls<Real>::draw_status_and_side(std::size_t i) {
  in_.isep[i] = random_.chance(0.5) ? separated : in_contact;
  in_.isurf[i] = random_.chance(0.5) ? face_above : face_below;
}

template <class Real>
Real random_calls<Real>::number(double zero_share, double grid_share) {
  if (random_.chance(zero_share)) return random_.chance(0.5) ? Real(0) : -Real(0);
  if (random_.chance(grid_share)) return static_cast<Real>(random_.whole(-16, 16)) / Real(8);
  const double scale = random_.chance(0.7) ? 1.0 : powers_of_ten[random_.whole(0, 8)];
  return static_cast<Real>((2 * random_.unit() - 1) * scale);
}

template <class Real>
void random_calls<Real>::place_pair(std::size_t i, int first_node, int nodes) {
  in_.id[i] = random_.whole(first_node, first_node + nodes - 1);
  this->draw_status_and_side(i);
  const std::size_t dof = in_.dof_of_pair(i);
  in_.dd[dof] = number(0.3, 0.5);
  in_.dtest[dof] = number(0.1, 0.5);
  // Some pairs stand at their face, some within EPSGAP of it.
  in_.cc[i] =
      random_.chance(0.3)
          ? in_.dd[dof] + static_cast<Real>(random_.chance(0.5) ? 0.0 : 2e-10 * (random_.unit() - 0.5))
          : number(0.2, 0.5);
}

template <class Real>
const call_inputs<Real>& random_calls<Real>::next() {
  this->draw_layout();
  const int pairs = random_.whole(1, random_.chance(0.5) ? 4 : most_pairs);
  this->resize(pairs);
  const int nodes = random_.whole(1, 80);
  const int first_node = random_.chance(0.05) ? last_node - nodes : random_.whole(1, 20);
  for (int i = 0; i < pairs; ++i) place_pair(i, first_node, nodes);
  return in_;
}

template <class Real>
const call_inputs<Real>& random_calls<Real>::at(std::uint64_t number) {
  this->begin(number);
  return next();
}

template <class Real>
Real adversarial_calls<Real>::nudged(Real x) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  const int ulps = random_.whole(-2, 2);
  for (int k = 0; k < std::abs(ulps); ++k) x = std::nextafter(x, ulps > 0 ? infinity : -infinity);
  return x;
}

template <class Real>
Real adversarial_calls<Real>::from_the_edges() {
  using limits = std::numeric_limits<Real>;
  constexpr std::array edges = {Real(0),
                                limits::denorm_min(),
                                limits::min() / 2,
                                limits::min(),
                                constants<Real>::epsgap,
                                Real(0.5),
                                Real(1),
                                Real(3),
                                limits::max(),
                                limits::infinity(),
                                limits::max() / 2,
                                limits::quiet_NaN()};
  const Real x = edges[random_.whole(0, edges.size() - 1)];
  return random_.chance(0.5) ? x : -x;
}

/// A response that keeps products with a scale factor exact, or any.
template <class Real>
Real adversarial_calls<Real>::some_response() {
  const Real power = std::ldexp(Real(1), random_.whole(-6, 6));
  const Real x = random_.chance(0.6) ? power : static_cast<Real>(0.1 + random_.unit());
  return random_.chance(0.5) ? x : -x;
}

/// c - D = `gap`, with D at zero, or with c at zero, or somewhere else as far as rounding allows.
template <class Real>
void adversarial_calls<Real>::place_gap(std::size_t dof, std::size_t i, Real gap) {
  const int where = random_.whole(0, 3);
  in_.dd[dof] = where == 0 ? -gap : where == 1 ? static_cast<Real>(random_.unit()) : Real(0);
  in_.cc[i] = where == 0 ? Real(0) : in_.dd[dof] + gap;
}

template <class Real>
void adversarial_calls<Real>::place_pair(std::size_t i) {
  this->draw_status_and_side(i);
  if (random_.chance(0.02)) in_.isep[i] = random_.whole(-2, 2);
  const std::size_t dof = in_.dof_of_pair(i);
  Real& response = in_.dtest[dof];
  response = some_response();
  switch (random_.whole(0, 7)) {
    case 0:  // IF (DTEST.EQ.0.)
      response = nudged(Real(0));
      if (random_.chance(0.3)) response = -Real(0);
      return place_gap(dof, i, random_.chance(0.5) ? Real(0) : s_);
    case 1:  // ABS(GAP).LT.EPSGAP
      return place_gap(dof, i, (random_.chance(0.5) ? 1 : -1) * nudged(constants<Real>::epsgap));
    case 2:  // SSCHK.GT.0.
      if (random_.chance(0.4)) response = from_the_edges();
      // SSCHK * DELTA is about the smallest number there is: SS(I).GT.0. to the ULP.
      if (random_.chance(0.2)) response *= constants<Real>::delta / std::numeric_limits<Real>::denorm_min();
      in_.dd[dof] = static_cast<Real>(random_.unit());
      in_.cc[i] = in_.dd[dof];
      return;
    case 3:  // SS(I).LT.SMIN, DIFF of a tie
      return place_gap(dof, i, nudged(s_ * response));
    case 4: {  // DIFF.LT.EPSMUL
      const Real share = random_.chance(0.7) ? Real(1) + Real(1) / 256 : Real(1) - Real(1) / 256;
      return place_gap(dof, i, nudged(nudged(s_ * share) * response));
    }
    case 5:  // SMIN.EQ.1.
      return place_gap(dof, i, nudged(response));
    case 6:  // away
      return place_gap(dof, i, -s_ * response);
    default:
      response = from_the_edges();
      in_.dd[dof] = from_the_edges();
      in_.cc[i] = random_.chance(0.3) ? in_.dd[dof] : from_the_edges();
  }
}

template <class Real>
void adversarial_calls<Real>::draw_scale_factor() {
  switch (random_.whole(0, 4)) {
    case 0:
      s_ = nudged(Real(256) / Real(257));
      break;
    case 1:
      s_ = nudged(Real(1));
      break;
    case 2:
      s_ = Real(0.5);
      break;
    case 3:
      s_ = static_cast<Real>(random_.unit() * 1e-3);
      break;
    default:
      s_ = static_cast<Real>(random_.unit());
  }
}

template <class Real>
const call_inputs<Real>& adversarial_calls<Real>::at(std::uint64_t number) {
  this->begin(number);
  this->draw_layout();
  draw_scale_factor();
  const int pairs = random_.chance(0.0002)  ? random_.whole(900, 1200)
                    : random_.chance(0.002) ? 0
                                            : random_.whole(1, 6);
  this->resize(pairs);
  // Shared nodes are common among many pairs; beyond node 999 the log overflows.
  const int first = random_.chance(0.05) ? last_node - 150 : 1;
  const int nodes = random_.chance(0.2) ? 2 : pairs > 100 ? last_node : 150;
  for (int i = 0; i < pairs; ++i) in_.id[i] = random_.whole(first, std::min(first + nodes - 1, last_node));
  for (int i = 0; i < pairs; ++i) place_pair(i);
  return in_;
}

call_source::call_source(std::uint64_t seed, int real_bytes)
    : real_bytes_(real_bytes),
      random_r8_(seed),
      adversarial_r8_(seed ^ other_stream),
      random_r4_(seed),
      adversarial_r4_(seed ^ other_stream) {}

const call_inputs<double>& call_source::at(std::uint64_t number) {
  const bool random = number % 2 == 1;
  if (real_bytes_ == 8) return random ? random_r8_.at(number) : adversarial_r8_.at(number);
  const call_inputs<float>& narrow = random ? random_r4_.at(number) : adversarial_r4_.at(number);
  wide_.dd.resize(narrow.dd.size());
  wide_.dtest.resize(narrow.dtest.size());
  for (std::size_t i = 0; i < narrow.pairs(); ++i) {
    const std::size_t dof = narrow.dof_of_pair(i);
    wide_.dd[dof] = narrow.dd[dof];
    wide_.dtest[dof] = narrow.dtest[dof];
  }
  wide_.cc.assign(narrow.cc.begin(), narrow.cc.end());
  wide_.id = narrow.id;
  wide_.isep = narrow.isep;
  wide_.isurf = narrow.isurf;
  wide_.dof = narrow.dof;
  return wide_;
}

template class drawn_calls<float>;
template class drawn_calls<double>;
template class random_calls<float>;
template class random_calls<double>;
template class adversarial_calls<float>;
template class adversarial_calls<double>;

}  // namespace contct::lab
