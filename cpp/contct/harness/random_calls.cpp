#include "contct/harness/random_calls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contct/kernel/contct.hpp"
#include "contct/number/random.hpp"

namespace contct {
namespace {

constexpr int most_pairs = 64;
constexpr int last_node = 1100;  // nodes beyond 999 overflow the format I3 of unit 26
constexpr int most_dofs = 3 * last_node + 3;
constexpr double powers_of_ten[] = {1e-15, 1e-12, 1e-10, 1e-9, 1e-6, 1e-3, 1.0, 1e2, 1e5};
constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15;  // changes the seed of adversarial calls

/// Draws one call, with a random generator for this call alone.
template <class Real>
class drawn_call {
 public:
  using limits = std::numeric_limits<Real>;

  /// Overwrites the dd and dtest of the previous call with NaN, because no kernel may read these numbers.
  drawn_call(std::uint64_t seed, std::uint64_t number, call_inputs& in)
      : random_(random_numbers(seed ^ (number * 0xd1342543de82ef95)).bits()), in_(in) {
    for (std::size_t i = 0; i < in_.pairs(); ++i) {
      in_.dd[in_.dof_of_pair(i)] = limits::quiet_NaN();
      in_.dtest[in_.dof_of_pair(i)] = limits::quiet_NaN();
    }
    in_.dof = {random_.whole(1, 3), random_.whole(1, 3)};
    if (!in_.dd.empty()) return;
    in_.dd.assign(most_dofs, limits::quiet_NaN());
    in_.dtest = in_.dd;
  }

  void draw_random() {
    const int pairs = random_.whole(1, random_.chance(0.5) ? 4 : most_pairs);
    resize(pairs);
    const int nodes = random_.whole(1, 80);
    const int first_node = random_.chance(0.05) ? last_node - nodes : random_.whole(1, 20);
    for (int i = 0; i < pairs; ++i) place_random_pair(i, first_node, nodes);
  }

  void draw_adversarial() {
    s_ = scale_factor();
    const int pairs = random_.chance(0.0002)  ? random_.whole(900, 1200)
                      : random_.chance(0.002) ? 0
                                              : random_.whole(1, 6);
    resize(pairs);
    // If there are only two nodes, pairs share dofs. Nodes beyond 999 overflow the format I3 of unit 26.
    const int first = random_.chance(0.05) ? last_node - 150 : 1;
    const int nodes = random_.chance(0.2) ? 2 : pairs > 100 ? last_node : 150;
    for (int i = 0; i < pairs; ++i) in_.id[i] = random_.whole(first, std::min(first + nodes - 1, last_node));
    for (int i = 0; i < pairs; ++i) place_adversarial_pair(i);
  }

 private:
  void resize(int pairs) {
    in_.cc.resize(pairs);
    for (auto* list : {&in_.id, &in_.isep, &in_.isurf}) list->resize(pairs);
  }

  void draw_status_and_side(std::size_t i) {
    in_.isep[i] = random_.chance(0.5) ? separated : in_contact;
    in_.isurf[i] = random_.chance(0.5) ? face_above : face_below;
  }

  Real number(double zero_share, double grid_share) {
    if (random_.chance(zero_share)) return random_.chance(0.5) ? Real(0) : -Real(0);
    if (random_.chance(grid_share)) return static_cast<Real>(random_.whole(-16, 16)) / Real(8);
    const double scale = random_.chance(0.7) ? 1.0 : powers_of_ten[random_.whole(0, 8)];
    return static_cast<Real>((2 * random_.unit() - 1) * scale);
  }

  void place_random_pair(std::size_t i, int first_node, int nodes) {
    in_.id[i] = random_.whole(first_node, first_node + nodes - 1);
    draw_status_and_side(i);
    const Real d = number(0.3, 0.5);
    const Real response = number(0.1, 0.5);
    // Some pairs are at their face, or within EPSGAP of it.
    const Real face = random_.chance(0.3)
                          ? d + static_cast<Real>(random_.chance(0.5) ? 0.0 : 2e-10 * (random_.unit() - 0.5))
                          : number(0.2, 0.5);
    place(i, d, response, face);
  }

  void place(std::size_t i, Real d, Real response, Real face) {
    in_.dd[in_.dof_of_pair(i)] = d;
    in_.dtest[in_.dof_of_pair(i)] = response;
    in_.cc[i] = face;
  }

  /// `x`, or a number one or two ULP above or below it.
  Real nudged(Real x) {
    const int ulps = random_.whole(-2, 2);
    const Real towards = ulps > 0 ? limits::infinity() : -limits::infinity();
    for (int k = 0; k < std::abs(ulps); ++k) x = std::nextafter(x, towards);
    return x;
  }

  Real from_the_edges() {
    constexpr Real least = limits::denorm_min();
    constexpr Real normal = limits::min();
    constexpr Real gap = constants<Real>::epsgap;
    constexpr Real most = limits::max();
    constexpr Real nan = limits::quiet_NaN();
    constexpr std::array<Real, 12> edges = {0, least, normal / 2,         normal,   gap, 0.5, 1,
                                            3, most,  limits::infinity(), most / 2, nan};
    const Real x = edges[random_.whole(0, edges.size() - 1)];
    return random_.chance(0.5) ? x : -x;
  }

  /// A response: a power of 2, whose product with a scale factor is exact, or a number from 0.1 to 1.1.
  Real some_response() {
    const Real power = std::ldexp(Real(1), random_.whole(-6, 6));
    const Real x = random_.chance(0.6) ? power : static_cast<Real>(0.1 + random_.unit());
    return random_.chance(0.5) ? x : -x;
  }

  /// Sets c and D so that c - D is `gap`, up to rounding. Often c or D is zero.
  void place_gap(std::size_t i, Real response, Real gap) {
    const int where = random_.whole(0, 3);
    const Real d = where == 0 ? -gap : where == 1 ? static_cast<Real>(random_.unit()) : Real(0);
    place(i, d, response, where == 0 ? Real(0) : d + gap);
  }

  void place_adversarial_pair(std::size_t i) {
    draw_status_and_side(i);
    if (random_.chance(0.02)) in_.isep[i] = random_.whole(-2, 2);
    Real response = some_response();
    switch (random_.whole(0, 7)) {
      case 0:  // IF (DTEST.EQ.0.)
        response = nudged(Real(0));
        if (random_.chance(0.3)) response = -Real(0);
        return place_gap(i, response, random_.chance(0.5) ? Real(0) : s_);
      case 1:  // ABS(GAP).LT.EPSGAP
        return place_gap(i, response, (random_.chance(0.5) ? 1 : -1) * nudged(constants<Real>::epsgap));
      case 2: {  // SSCHK.GT.0.
        if (random_.chance(0.4)) response = from_the_edges();
        // SSCHK * DELTA is near the smallest number, so that SS(I).GT.0. is decided by one ULP.
        if (random_.chance(0.2)) response *= constants<Real>::delta / limits::denorm_min();
        const auto d = static_cast<Real>(random_.unit());
        return place(i, d, response, d);
      }
      case 3:  // SS(I).LT.SMIN, and DIFF near 0
        return place_gap(i, response, nudged(s_ * response));
      case 4: {  // DIFF.LT.EPSMUL
        const Real share = random_.chance(0.7) ? Real(1) + Real(1) / 256 : Real(1) - Real(1) / 256;
        return place_gap(i, response, nudged(nudged(s_ * share) * response));
      }
      case 5:  // SMIN.EQ.1.
        return place_gap(i, response, nudged(response));
      case 6:  // a pair that moves away from its face
        return place_gap(i, response, -s_ * response);
      default: {
        response = from_the_edges();
        const Real d = from_the_edges();
        place(i, d, response, random_.chance(0.3) ? d : from_the_edges());
      }
    }
  }

  Real scale_factor() {
    const int how = random_.whole(0, 4);
    if (how == 0) return nudged(Real(256) / Real(257));
    if (how == 1) return nudged(Real(1));
    if (how == 2) return Real(0.5);
    return static_cast<Real>(how == 3 ? random_.unit() * 1e-3 : random_.unit());
  }

  random_numbers random_;
  call_inputs& in_;
  Real s_ = 0;  // the scale factor near which an adversarial call has its ties
};

}  // namespace

const call_inputs& call_source::random(std::uint64_t number) {
  if (real_bytes_ == 4) drawn_call<float>(seed_, number, in_).draw_random();
  if (real_bytes_ == 8) drawn_call<double>(seed_, number, in_).draw_random();
  return in_;
}

const call_inputs& call_source::adversarial(std::uint64_t number) {
  if (real_bytes_ == 4) drawn_call<float>(seed_ ^ other_stream, number, in_).draw_adversarial();
  if (real_bytes_ == 8) drawn_call<double>(seed_ ^ other_stream, number, in_).draw_adversarial();
  return in_;
}

}  // namespace contct
