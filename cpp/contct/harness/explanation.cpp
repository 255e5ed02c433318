#include "contct/harness/explanation.hpp"

#include <algorithm>
#include <cmath>

namespace contct {
namespace {

template <class Real>
explained_pair start_of(const call<Real>& c, std::span<const int> isep_before, std::size_t i) {
  const pair_numbers<Real> of(c, isep_before, i);
  explained_pair p;
  p.pair = static_cast<int>(i);
  p.node = c.id[i];
  p.surface = c.isurf[i];
  p.isep_before = isep_before[i];
  p.isep_after = c.isep[i];
  p.c = c.cc[i];
  p.d = of.d;
  p.d_star = of.d_star;
  p.gap = of.gap;
  p.s = c.ss[i];
  p.distance = std::abs(p.c - (p.d + static_cast<double>(c.smin) * p.d_star));
  return p;
}

listing_line line_of_s(const explained_pair& p) {
  if (p.is_true(branch::no_response)) return listing::no_response;
  if (!p.is_true(branch::stationary)) return listing::moving;
  return p.is_true(branch::check_positive) ? listing::if_check_positive : listing::stationary;
}

/// Stores each decision with the pair that it concerns, and the decision with the smallest margin in `out`.
template <class Real>
void take_decisions(const call<Real>& c, std::span<const int> isep_before, explained_call& out) {
  for_each_decision(c, isep_before, [&out](branch b, std::size_t i, bool outcome, Real left, Real right) {
    const decision d{b, i, outcome, left, right};
    keep_narrower(out.narrowest, d);
    if (b == branch::no_events) return;
    explained_pair& p = out.pairs[i];
    p.taken[index_of(b)] = d;
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
  if (!p.is_true(branch::within_epsmul)) return why_toggled::not_toggled;
  if (p.pair == winner) return why_toggled::winner;
  if (!p.is_candidate()) return why_toggled::by_mark;
  if (p.set_s == listing::if_check_positive) return why_toggled::same_moment;
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
    p.set_s = line_of_s(p);
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
  return in_precision(c.c, real_bytes,
                      [&](const auto& own) { return explain_in(own, c.isep_before, largest); });
}

}  // namespace contct
