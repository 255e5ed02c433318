#include "contct/lab/adversarial_calls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace contct {
namespace {

constexpr int last_node = 1100;  // beyond 999, I3 of the log overflows
constexpr int most_dofs = 3 * last_node + 3;

template <class Real>
constexpr Real epsgap = sizeof(Real) == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);

}  // namespace

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
  constexpr std::array edges = {Real(0),           limits::denorm_min(),
                                limits::min() / 2, limits::min(),
                                epsgap<Real>,      Real(0.5),
                                Real(1),           Real(3),
                                limits::max(),     limits::infinity(),
                                limits::max() / 2, limits::quiet_NaN()};
  const Real x = edges[static_cast<std::size_t>(random_.whole(0, edges.size() - 1))];
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
  in_.isep[i] = random_.chance(0.5) ? separated : in_contact;
  in_.isurf[i] = random_.chance(0.5) ? face_above : face_below;
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
      return place_gap(dof, i, (random_.chance(0.5) ? 1 : -1) * nudged(epsgap<Real>));
    case 2:  // SSCHK.GT.0.
      if (random_.chance(0.4)) response = from_the_edges();
      // SSCHK * DELTA is about the smallest number there is: SS(I).GT.0. to the ULP.
      if (random_.chance(0.2)) response *= static_cast<Real>(1e-20) / std::numeric_limits<Real>::denorm_min();
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
void adversarial_calls<Real>::begin_call() {
  using limits = std::numeric_limits<Real>;
  if (in_.dd.empty()) {
    in_.dd.assign(most_dofs, limits::quiet_NaN());
    in_.dtest.assign(most_dofs, limits::quiet_NaN());
  }
  for (std::size_t i = 0; i < in_.pairs(); ++i) {
    in_.dd[in_.dof_of_pair(i)] = limits::quiet_NaN();
    in_.dtest[in_.dof_of_pair(i)] = limits::quiet_NaN();
  }
  in_.dof = {random_.whole(1, 3), random_.whole(1, 3)};
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
  random_ = random_numbers(random_numbers(seed_ ^ (number * 0xd1342543de82ef95)).bits());
  begin_call();
  const auto pairs = static_cast<std::size_t>(random_.chance(0.0002)  ? random_.whole(900, 1200)
                                              : random_.chance(0.002) ? 0
                                                                      : random_.whole(1, 6));
  in_.cc.resize(pairs);
  in_.id.resize(pairs);
  in_.isep.resize(pairs);
  in_.isurf.resize(pairs);
  // Shared nodes are common among many pairs; beyond node 999 the log overflows.
  const int first = random_.chance(0.05) ? last_node - 150 : 1;
  const int nodes = random_.chance(0.2) ? 2 : pairs > 100 ? last_node : 150;
  for (std::size_t i = 0; i < pairs; ++i)
    in_.id[i] = random_.whole(first, std::min(first + nodes - 1, last_node));
  for (std::size_t i = 0; i < pairs; ++i) place_pair(i);
  return in_;
}

template class adversarial_calls<float>;
template class adversarial_calls<double>;

}  // namespace contct
