#include "contct/structure/structure.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "contct/structure/line.hpp"

namespace contct {

load mix(const load& before, const load& after, double fraction) {
  if (fraction == 1.0) return after;
  load sum;
  sum.name = after.name;
  const std::array shares = {std::pair(&before, 1.0 - fraction), std::pair(&after, fraction)};
  for (const auto values : nodal_values) {
    std::map<std::pair<int, int>, double> at;
    for (const auto& [part, share] : shares)
      for (const nodal_value& v : part->*values)
        at[{v.node, v.dof}] += share * product_of<double>(v.value, v.factor);
    for (const auto& [place, value] : at) (sum.*values).push_back({place.first, place.second, value});
  }
  std::map<std::vector<int>, std::vector<double>> distributed;
  std::map<std::tuple<load_kind, line_place, line_place, std::array<line_place, 2>>, std::vector<double>>
      placed;
  for (const auto& [part, share] : shares) {
    for (const distributed_load& d : part->distributed)
      add_polynomial(distributed[d.elements], d.polynomial, share);
    for (const placed_load& p : part->placed)
      add_polynomial(placed[{p.what, p.from, p.to, p.across}], values_of(p), share);
  }
  for (const auto& [elements, polynomial] : distributed) sum.distributed.push_back({polynomial, elements});
  for (const auto& [at, polynomial] : placed) {
    const auto& [what, from, to, across] = at;
    sum.placed.push_back({what, from, to, polynomial, across});
  }
  return sum;
}

std::vector<double> values_of(const placed_load& p) {
  std::vector<double> values;
  add_polynomial(values, p.polynomial, p.factor);
  return values;
}

void add_polynomial(std::vector<double>& sum, std::span<const double> part, double share) {
  sum.resize(std::max(sum.size(), part.size()), 0.0);
  for (std::size_t i = 0; i < part.size(); ++i) sum[i] += share * part[i];
}

std::vector<gauss_point> gauss_points(int n) {
  std::vector<gauss_point> points;
  for (int i = 0; i < n; ++i) {
    // Newton's method from Tricomi's approximation of the i-th root of the Legendre polynomial P_n.
    double z = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int step = 0; step < 20; ++step) {
      double p = 1.0;
      double previous = 0.0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * z * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = n * (z * p - previous) / (z * z - 1);
      const double correction = p / slope;
      z -= correction;
      if (std::abs(correction) < 1e-16) break;
    }
    points.push_back({(1 - z) / 2, 1 / ((1 - z * z) * slope * slope)});
  }
  return points;
}

std::vector<int> linear_structure::pairs_that_hold(rigid_rank& rank) const {
  std::vector<int> holding;
  for (std::size_t i = 0; i < pairs.size() && !is_held(rank); ++i) {
    const int before = rank.rank();
    hold(rank, i);
    if (rank.rank() > before) holding.push_back(static_cast<int>(i));
  }
  return holding;
}

std::optional<free_motion> linear_structure::driven_motion(const rigid_rank& held,
                                                           std::span<const double> load,
                                                           const rigid_work& work) const {
  if (truth && work) return truth->driven_by(work, held.dofs(), rigid_rows);
  constexpr double rounding_of_work = 1e-12;
  constexpr double rounding_of_motion = 1e-10;
  rigid_row sum{};
  rigid_row size{};
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    if (fixed[dof] != 0) continue;
    for (std::size_t m = 0; m < sum.size(); ++m) {
      sum[m] += load[dof] * rigid_rows[dof][m];
      size[m] += std::abs(load[dof] * rigid_rows[dof][m]);
    }
  }
  rigid_rank by_rows(rigid_rows, std::max(1e-12, rigid_rounding));
  if (!truth) by_rows = held;
  for (const int dof : held.dofs())
    if (truth) by_rows.hold(dof);
  rigid_row motion = by_rows.free_part(sum);
  const double driven = largest_of(motion);
  if (!(driven > std::max(rounding_of_work, rigid_rounding) * largest_of(size))) return std::nullopt;
  for (double& part : motion) part /= driven;
  const double still = std::max(rounding_of_motion, rigid_rounding);
  return free_motion{[motion, still, rows = std::span(rigid_rows)](int dof) {
                       const double moved = along(motion, rows[dof]);
                       return std::abs(moved) >= still * largest_of(rows[dof]) ? moved : 0.0;
                     },
                     along(motion, sum)};
}

namespace {

/// A power of four near `stiffness`, because the square root of a power of four is exact.
double power_of_four_near(double stiffness) {
  constexpr int largest = 511;  // 4^512 overflows
  if (!(stiffness > 0.0)) return 1.0;
  return std::ldexp(1.0, 2 * std::min(largest, static_cast<int>(std::lround(std::log2(stiffness) / 2))));
}

/// Decouples the rows of fixed dofs; keeps in to_settling the entries that couple settling to free dofs.
void fix(linear_structure& s) {
  std::vector<double> pivots(s.fixed.size(), 0.0);
  std::vector<char> settling_rows(s.settles.size(), 0);
  std::vector<int> dof_of_row(s.fixed.size());
  for (int dof = 0; dof < s.dofs(); ++dof) {
    const int row = s.row_of(dof);
    dof_of_row[row] = dof;
    if (s.fixed[dof] == 0) continue;
    const bool settles = !s.settles.empty() && s.settles[dof] != 0;
    if (settles) settling_rows[row] = 1;
    pivots[row] = settles ? power_of_four_near(s.stiffness.diagonal(row)) : 1.0;
  }
  if (!s.settles.empty())
    for (const auto& [row, column, value] : s.stiffness.entries_in(settling_rows))
      if (pivots[row] == 0.0) s.to_settling.push_back({dof_of_row[row], dof_of_row[column], value});
  s.stiffness.fix(pivots);
}

}  // namespace

void put_on_supports(linear_structure& s, std::span<const support> supports,
                     std::vector<pair_in<double>> pairs) {
  s.fixed.assign(s.dofs(), 0);
  if (std::any_of(supports.begin(), supports.end(), [](const support& p) { return p.settles; }))
    s.settles.assign(s.dofs(), 0);
  for (const support& p : supports) {
    const int dof = p.node * s.dofs_per_node + p.dof;
    if (p.fixed) {
      s.fixed[dof] = 1;
      if (p.settles) s.settles[dof] = 1;
    } else {
      s.stiffness.diagonal(s.row_of(dof)) += p.spring;
    }
    s.supported_dofs.push_back(dof);
  }
  fix(s);
  s.pairs = std::move(pairs);
  // Drops the zeros in the rows of fixed dofs. Pairs between two dofs may need entries that are 0.
  if (s.stiffness.is_band() && !s.has_pairs_of_two()) s.stiffness = s.stiffness.band();
}

std::vector<double> right_hand_side(const linear_structure& s, const loads_in<double>& l) {
  std::vector<double> f = l.force;
  for (std::size_t dof = 0; dof < f.size(); ++dof) {
    const bool settles = !s.settles.empty() && s.settles[dof] != 0;
    if (settles) f[dof] = l.settlement[dof];
    if (!settles && l.settlement[dof] != 0.0)
      throw std::logic_error("dof " + std::to_string(dof + 1) + " was not built to settle");
  }
  for (const auto& [free, settling, value] : s.to_settling) f[free] -= value * f[settling];
  if (!l.moves_faces()) return f;
  std::vector<double> m(f.size());
  std::vector<long double> needed(f.size());
  for (std::size_t dof = 0; dof < m.size(); ++dof) {
    needed[s.row_of(dof)] = f[dof];
    if (s.fixed[dof] == 0) m[s.row_of(dof)] = l.moved[dof];
  }
  s.stiffness.subtract_product(m, needed);
  for (std::size_t dof = 0; dof < m.size(); ++dof)
    f[dof] = s.fixed[dof] == 0 ? static_cast<double>(needed[s.row_of(dof)]) : f[dof] - l.moved[dof];
  return f;
}

}  // namespace contct
