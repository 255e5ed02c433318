// Calls with one pair, or with a few pairs at separate nodes.
#pragma once

#include <algorithm>
#include <vector>

#include "contct/kernel/contct.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/number/bits.hpp"

namespace contct {

// Short names for tables of pairs.
inline constexpr int apart = separated;
inline constexpr int touching = in_contact;
inline constexpr int above = face_above;
inline constexpr int below = face_below;

/// The state of a pair before a call.
template <class Real>
struct pair_at {
  Real d = 0;       ///< D
  Real d_star = 0;  ///< d*
  Real c = 0;       ///< face
  int isep = separated;
  int isurf = face_above;
};

/// A call that owns its arrays, with pair i at node i + 1 and one dof per node.
template <class Real>
struct small_call {
  std::vector<Real> dd, dtest, cc, ss;
  std::vector<int> id, isep, isurf, before;
  std::vector<event> events;
  Real smin = 0;

  explicit small_call(const std::vector<pair_at<Real>>& pairs) {
    for (const auto& p : pairs) {
      dd.push_back(p.d);
      dtest.push_back(p.d_star);
      cc.push_back(p.c);
      id.push_back(static_cast<int>(id.size()) + 1);
      isep.push_back(p.isep);
      isurf.push_back(p.isurf);
    }
    ss.resize(pairs.size());
    events.resize(pairs.size());
  }

  call<Real> arguments() { return {dd, dtest, cc, ss, Real(0), id, isep, isurf, {1, 1}}; }

  /// Has a function answer the call.
  template <class Function>
  small_call& ask_by(Function answer) {
    before = isep;
    call<Real> c = arguments();
    answer(c);
    smin = c.smin;
    return *this;
  }
  small_call& ask(kernel& k) {
    return ask_by([&k](call<double>& c) { k.answer(c); });
  }
  /// Calls the C++ kernel.
  small_call& ask() {
    events.resize(cc.size());
    return ask_by([this](call<Real>& c) {
      events.resize(static_cast<std::size_t>(contct(c, std::span<event>(events))));
    });
  }

  /// Returns the call with the answer of `ask`.
  answered_call answered() {
    call<Real> c = arguments();
    c.smin = smin;
    return {c, before};
  }
};

template <class Real>
bool equal_bits(const std::vector<Real>& a, const std::vector<Real>& b) {
  return std::ranges::equal(a, b, [](Real x, Real y) { return same_bits(x, y); });
}

}  // namespace contct
