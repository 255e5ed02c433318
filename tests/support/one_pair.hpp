// Calls with one pair, or with a few pairs at separate nodes, and a kernel's answer to a call.
#pragma once

#include <vector>

#include "contct/kernel/contct.hpp"
#include "contct/kernel/kernel.hpp"

namespace contct {

// Short names for tables of pairs.
inline constexpr int apart = separated;
inline constexpr int touching = in_contact;
inline constexpr int above = face_above;
inline constexpr int below = face_below;

/// The state of a pair before a call.
template <class Real>
struct pair_at {
  Real d;       ///< D
  Real d_star;  ///< d*
  Real c;       ///< face
  int isep;
  int isurf;
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

  /// Calls the C++ kernel.
  small_call& ask() {
    before = isep;
    call<Real> c = arguments();
    events.resize(static_cast<std::size_t>(contct(c, std::span<event>(events))));
    smin = c.smin;
    return *this;
  }

  /// Returns the call with the answer of `ask`.
  answered_call answered() {
    call<Real> c = arguments();
    c.smin = smin;
    return {c, before};
  }
};

/// Returns a kernel's answer.
inline call_outputs answer_of(kernel& k, const call_inputs<double>& in) {
  call_outputs out;
  call<double> c = out.prepare(in);
  k.answer(c);
  out.smin = c.smin;
  out.text = k.take_text();
  return out;
}

}  // namespace contct
