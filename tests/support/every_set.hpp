// The truth about a small contact problem: every set of closed pairs is tried, dense, in long double.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <vector>

#include "contct/kernel/call.hpp"
#include "contct/structure/structure.hpp"

namespace contct::app {

using long_numbers = std::vector<long double>;

/// A set of closed pairs: bit i for pair i.
using pair_bits = unsigned;

[[nodiscard]] inline bool is_in(pair_bits set, std::size_t pair) {
  return (set >> pair & 1U) != 0;
}

/// Solve A x = b in place by a dense Cholesky factor; A [n * n] is overwritten.
inline void solve_dense(long_numbers& a, long_numbers& b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      for (std::size_t i = j; i < n; ++i) a[i * n + j] -= a[i * n + k] * a[j * n + k];
    }
    const long double pivot = std::sqrt(a[j * n + j]);
    for (std::size_t i = j; i < n; ++i) a[i * n + j] /= pivot;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

/// Where the structure stands with the springs of `set` working both ways and all others out.
[[nodiscard]] inline long_numbers stands_with(const linear_structure& s, std::span<const double> load,
                                              pair_bits set) {
  const std::size_t n = load.size();
  const auto row = [&s](std::size_t dof) {
    return static_cast<std::size_t>(s.row_of(static_cast<int>(dof)));
  };
  long_numbers a(n * n);
  long_numbers b(n);
  for (int j = 0; j < s.dofs(); ++j) {
    for (int i = j; i <= std::min(j + s.stiffness.band().subdiagonals(), s.dofs() - 1); ++i)
      a[static_cast<std::size_t>(i) * n + static_cast<std::size_t>(j)] = s.stiffness.band().at(i, j);
  }
  for (std::size_t dof = 0; dof < n; ++dof) b[row(dof)] = load[dof];
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    if (!is_in(set, i)) continue;
    const std::size_t at = row(static_cast<std::size_t>(s.dof_of_pair(static_cast<int>(i))));
    a[at * n + at] += s.pairs[i].stiffness;
    b[at] += static_cast<long double>(s.pairs[i].stiffness) * s.pairs[i].face;
  }
  for (std::size_t dof = 0; dof < n; ++dof) {
    if (s.fixed[dof] != 0) b[row(dof)] = 0.0L;
  }
  solve_dense(a, b);
  long_numbers u(n);
  for (std::size_t dof = 0; dof < n; ++dof) u[dof] = b[row(dof)];
  return u;
}

/// n (w - c) of a pair.
[[nodiscard]] inline long double pressing(const linear_structure& s, const long_numbers& u,
                                          std::size_t pair) {
  const contact_pair& p = s.pairs[pair];
  return p.surface * (u[static_cast<std::size_t>(s.dof_of_pair(static_cast<int>(pair)))] - p.face);
}

/// The pairs that press at `u`.
[[nodiscard]] inline pair_bits pressed_at(const linear_structure& s, const long_numbers& u) {
  pair_bits set = 0;
  for (std::size_t i = 0; i < s.pairs.size(); ++i) set |= (pressing(s, u, i) > 0 ? 1U : 0U) << i;
  return set;
}

[[nodiscard]] inline long double largest_deflection(const linear_structure& s, const long_numbers& u) {
  const auto stride = static_cast<std::size_t>(s.dofs_per_node);
  long double largest = 0.0L;
  for (std::size_t dof = 0; dof < u.size(); dof += stride) largest = std::max(largest, std::abs(u[dof]));
  return largest;
}

/// The farthest that a pair of `set` is from its face, or any other one beyond it, of the largest deflection.
[[nodiscard]] inline long double wrong_with(const linear_structure& s, const long_numbers& u, pair_bits set) {
  long double wrong = 0.0L;
  for (std::size_t i = 0; i < s.pairs.size(); ++i)
    wrong = std::max(wrong, is_in(set, i) ? -pressing(s, u, i) : pressing(s, u, i));
  return wrong > 0 ? wrong / largest_deflection(s, u) : 0.0L;
}

/// The equilibrium, the pairs that its set closes, and what that leaves wrong.
struct equilibrium {
  long_numbers u;
  pair_bits set = 0;
  long double wrong = std::numeric_limits<long double>::infinity();
};

/// Of all sets the one least wrong, where supports hold the structure: the energy is convex, so a set that is
/// not wrong at all has the equilibrium.
[[nodiscard]] inline equilibrium least_wrong(const linear_structure& s, std::span<const double> load) {
  equilibrium best;
  for (pair_bits set = 0; set < 1U << s.pairs.size(); ++set) {
    const long_numbers u = stands_with(s, load, set);
    const long double wrong = wrong_with(s, u, set);
    if (wrong < best.wrong) best = {u, set, wrong};
  }
  return best;
}

/// How a plain active set goes: the next set is what presses where the last one stands.
struct plain_active_set {
  bool ends = false;                ///< else a set returned that is not its own next
  long double nearest_face = 1.0L;  ///< that any pair came to in any of the sets, of the largest deflection
};

[[nodiscard]] inline plain_active_set follow_plain_active_set(const linear_structure& s,
                                                              std::span<const double> load, pair_bits set) {
  plain_active_set way;
  std::set<pair_bits> seen;
  while (seen.insert(set).second) {
    const long_numbers u = stands_with(s, load, set);
    const long double largest = largest_deflection(s, u);
    for (std::size_t i = 0; i < s.pairs.size(); ++i)
      way.nearest_face = std::min(way.nearest_face, std::abs(pressing(s, u, i)) / largest);
    const pair_bits next = pressed_at(s, u);
    way.ends = next == set;
    if (way.ends) break;
    set = next;
  }
  return way;
}

}  // namespace contct::app
