#include "contct/compare/explanation.hpp"

#include <algorithm>
#include <cmath>

namespace contct {
namespace {

template <class Real>
explained_pair start_of(const call<Real>& c, std::span<const int> isep_before, std::size_t i) {
  const int dof = c.dof.dof_of(c.id[i]) - 1;
  explained_pair p;
  p.pair = static_cast<int>(i);
  p.node = c.id[i];
  p.surface = c.isurf[i];
  p.isep_before = isep_before[i];
  p.isep_after = c.isep[i];
  p.c = c.cc[i];
  p.d = c.dd[dof];
  p.d_star = c.dtest[dof];
  const Real gap = c.cc[i] - c.dd[dof];
  p.gap = gap;
  p.s = c.ss[i];
  p.distance = std::abs(p.c - (p.d + static_cast<double>(c.smin) * p.d_star));
  return p;
}

listing_branch way_of(const explained_pair& p) {
  if (p.at(branch::no_response).outcome) return listing_branch::no_response;
  if (!p.at(branch::stationary).outcome) return listing_branch::moving;
  return p.at(branch::check_positive).outcome ? listing_branch::stationary_event : listing_branch::stationary;
}

/// Stores each decision with the pair that it concerns, and the decision with the smallest margin in `out`.
template <class Real>
void take_decisions(const call<Real>& c, std::span<const int> isep_before, explained_call& out) {
  for_each_decision(c, isep_before, [&out](branch b, std::size_t i, bool outcome, Real left, Real right) {
    const std::uint64_t ulps = margin_between(left, right);
    keep_narrower(out.narrowest, b, i, outcome, ulps);
    if (b == branch::no_events) return;
    explained_pair& p = out.pairs[i];
    p.taken[index_of(b)] = {true, outcome, ulps};
    if (b == branch::check_positive) p.s_chk = left;
    if (b == branch::s_is_smallest) p.smin_before = right;
    if (b == branch::within_epsmul) p.diff = left;
  });
}

void find_winner(explained_call& out) {
  for (const explained_pair& p : out.pairs) {
    if (p.took_the_lead()) out.winner = p.pair;
  }
  for (const explained_pair& p : out.pairs) {
    if (p.pair == out.winner || !p.is_candidate()) continue;
    if (out.next < 0 || p.s < out.pairs[out.next].s) out.next = p.pair;
  }
}

why_toggled reason(const explained_pair& p, int winner, double rounding) {
  if (!p.at(branch::within_epsmul).outcome) return why_toggled::not_toggled;
  if (p.pair == winner) return why_toggled::winner;
  if (!p.is_candidate()) return why_toggled::by_mark;
  if (p.way == listing_branch::stationary_event) return why_toggled::same_moment;
  return p.distance > rounding ? why_toggled::too_early : why_toggled::same_moment;
}

template <class Real>
explained_call explain_in(const call<Real>& c, std::span<const int> isep_before, double& largest) {
  explained_call out;
  out.real_bytes = sizeof(Real);
  out.smin = c.smin;
  out.pairs.reserve(c.cc.size());
  for (std::size_t i = 0; i < c.cc.size(); ++i) out.pairs.push_back(start_of(c, isep_before, i));
  take_decisions(c, isep_before, out);
  for (explained_pair& p : out.pairs) {
    p.way = way_of(p);
    const double reached = std::abs(p.d + out.smin * p.d_star);
    if (std::isfinite(reached)) largest = std::max(largest, reached);
  }
  find_winner(out);
  if (out.winner >= 0 && out.next >= 0) out.ulps_ahead = margin_between(c.ss[out.winner], c.ss[out.next]);
  const double rounding = rounding_share(sizeof(Real)) * largest;
  for (explained_pair& p : out.pairs) p.why = reason(p, out.winner, rounding);
  return out;
}

}  // namespace

explained_call explain(const answered_call& c, int real_bytes, double& largest) {
  if (real_bytes == 8) return explain_in<double>(c.c, c.isep_before, largest);
  return as_float_call(c.c,
                       [&](const call<float>& f) { return explain_in<float>(f, c.isep_before, largest); });
}

}  // namespace contct
