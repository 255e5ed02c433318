// Tests Adini-Clough-Melosh plates against fields that they reproduce exactly, and against Navier's series.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "catch.hpp"
#include "contct/structure/statics.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

/// Returns a plate whose elements all have different sizes.
plate uneven_plate(double scale_x = 1.0, double scale_y = 1.0) {
  plate p{{-1.0, 0.2, 0.5, 2.0}, {0.0, 0.7, 1.0, 1.1, 3.0}, 2.5, 0.3};
  for (double& x : p.x) x *= scale_x;
  for (double& y : p.y) y *= scale_y;
  return p;
}

/// Returns K u for u in the order of the dofs.
std::vector<double> multiply(const linear_structure& s, const std::vector<double>& u) {
  std::vector<double> in(u.size());
  for (int d = 0; d < s.dofs(); ++d) in[s.row_of(d)] = u[d];
  const std::vector<double> out = product(s.stiffness.band(), in);
  std::vector<double> f(u.size());
  for (int d = 0; d < s.dofs(); ++d) f[d] = out[s.row_of(d)];
  return f;
}

/// A deflection: the sum of c (x - x0)^m (y - y0)^n over all {c, m, n}.
struct field {
  std::vector<std::array<double, 3>> terms;
  double x0 = 0.0, y0 = 0.0;

  /// Returns the deflection, or its derivative of the orders dx and dy.
  [[nodiscard]] double at(double x, double y, int dx = 0, int dy = 0) const {
    const auto power = [](double of, double m, int order) {
      double factor = 1.0;
      for (int i = 0; i < order; ++i) factor *= m - i;
      return factor == 0.0 ? 0.0 : factor * std::pow(of, m - order);
    };
    double sum = 0.0;
    for (const auto& [c, m, n] : terms) sum += c * power(x - x0, m, dx) * power(y - y0, n, dy);
    return sum;
  }
};

std::vector<double> at_nodes(const plate& p, const field& w) {
  std::vector<double> u;
  for (const double y : p.y)
    for (const double x : p.x) u.insert(u.end(), {w.at(x, y), w.at(x, y, 1, 0), w.at(x, y, 0, 1)});
  return u;
}

/// Checks the moments at the corners of all elements under this deflection.
void check_moments(const plate& p, const field& w, double allowed) {
  const element_results moments = results_in_elements(p, {}, at_nodes(p, w));
  REQUIRE(moments.values.size() == std::size_t{12} * p.elements());
  for (int e = 0; e < p.elements(); ++e) {
    const auto corners = p.corners_of(e);
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = p.x[corners[k] % p.columns()];
      const double y = p.y[corners[k] / p.columns()];
      const double xx = w.at(x, y, 2, 0);
      const double yy = w.at(x, y, 0, 2);
      CHECK(moments.at(e, 0)[k] == Approx(p.D * (xx + p.nu * yy)).margin(allowed));
      CHECK(moments.at(e, 1)[k] == Approx(p.D * (yy + p.nu * xx)).margin(allowed));
      CHECK(moments.at(e, 2)[k] == Approx(p.D * (1 - p.nu) * w.at(x, y, 1, 1)).margin(allowed));
    }
  }
}

/// Returns the largest difference between `a` and `b` in w, wx or wy, relative to the largest w, wx or wy of
/// `b`.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0.0;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    double off = 0.0;
    double largest = 0.0;
    for (std::size_t i = kind; i < a.size(); i += 3) {
      off = std::max(off, std::abs(a[i] - b[i]));
      largest = std::max(largest, std::abs(b[i]));
    }
    if (largest > 0.0) worst = std::max(worst, off / largest);
  }
  return worst;
}

/// Loads under which a plate has the uniform moments m_x, m_y and m_xy, and its deflection with w = wx = wy =
/// 0 at the first node.
struct uniform_state {
  load l;
  field w;
};

/// Moments along the edges.
uniform_state bent_by(const plate& p, double m_x, double m_y) {
  load l;
  const int right = p.columns() - 1;
  const int top = p.rows() - 1;
  const auto share = [](const std::vector<double>& lines, int i) {
    return (lines[std::min(i + 1, static_cast<int>(lines.size()) - 1)] - lines[std::max(i - 1, 0)]) / 2;
  };
  for (int j = 0; j <= top; ++j)
    for (const int side : {-1, 1})
      l.points.push_back({p.node_at(side < 0 ? 0 : right, j), 1, side * m_x * share(p.y, j)});
  for (int i = 0; i <= right; ++i)
    for (const int side : {-1, 1})
      l.points.push_back({p.node_at(i, side < 0 ? 0 : top), 2, side * m_y * share(p.x, i)});
  const double stiff = 2 * p.D * (1 - p.nu * p.nu);
  return {l, {{{(m_x - p.nu * m_y) / stiff, 2, 0}, {(m_y - p.nu * m_x) / stiff, 0, 2}}, p.x[0], p.y[0]}};
}

/// Forces of 2 m_xy at the corners.
uniform_state twisted_by(const plate& p, double m_xy) {
  const int right = p.columns() - 1;
  const int top = p.rows() - 1;
  return {{{{p.node_at(0, 0), 0, 2 * m_xy},
            {p.node_at(right, 0), 0, -2 * m_xy},
            {p.node_at(right, top), 0, 2 * m_xy},
            {p.node_at(0, top), 0, -2 * m_xy}},
           {}},
          {{{m_xy / p.D / (1 - p.nu), 1, 1}}, p.x[0], p.y[0]}};
}

/// Supports of w, wx and wy at the lower left node only.
const std::vector<support> at_first_node = {{0, 0, true}, {0, 1, true}, {0, 2, true}};

/// A quarter of PP1's square plate of side 1 under a unit pressure downwards. Supports fix w and the slope
/// along the edges x = 0 and y = 0; the other two edges are lines of symmetry.
struct loaded_quarter {
  explicit loaded_quarter(int n, double unit = 1.0, double D = 1.0)
      : p{even_beam(0.5 * unit, n, 1.0).x, even_beam(0.5 * unit, n, 1.0).x, D, 0.3} {
    for (int i = 0; i <= n; ++i) {
      for (const int node : {p.node_at(0, i), p.node_at(i, 0)}) supports.push_back({node, 0, true});
      supports.push_back({p.node_at(0, i), 2, true});
      supports.push_back({p.node_at(i, 0), 1, true});
      supports.push_back({p.node_at(n, i), 1, true});
      supports.push_back({p.node_at(i, n), 2, true});
    }
    u = displaced(p, supports, pressure);
  }
  [[nodiscard]] double middle() const { return u[u.size() - 3]; }
  [[nodiscard]] double corner() const { return reactions(p, pressure, supports, u)[0]; }
  /// Returns mx or my in the middle.
  [[nodiscard]] double moment(std::size_t name) const {
    return results_in_elements(p, {}, u).at(p.elements() - 1, name)[2];
  }

  plate p;
  load pressure{{}, {{{-1.0}, {}}}};
  std::vector<support> supports;
  std::vector<double> u;
};

load rectangle(double pressure, std::array<double, 2> x, std::array<double, 2> y) {
  load l;
  l.placed = {{load_kind::force, x[0], x[1], {pressure}, {y[0], y[1]}}};
  return l;
}

std::vector<double> nodal_forces(const plate& p, const load& l) {
  return nodal_loads(p, l).force;
}

/// Returns the mean of the n-th power from a to b.
double mean(double a, double b, int n) {
  return (std::pow(b, n + 1) - std::pow(a, n + 1)) / (n + 1) / (b - a);
}

/// Returns a load's work on x^m y^n, which the elements reproduce exactly.
double work_on(const plate& p, const load& l, int m, int n) {
  const std::vector<double> f = nodal_forces(p, l);
  const std::vector<double> u = at_nodes(p, {{{1.0, 1.0 * m, 1.0 * n}}});
  return std::inner_product(f.begin(), f.end(), u.begin(), 0.0);
}

}  // namespace

TEST_CASE("the three rigid-body motions of a plate need no force") {
  for (const plate& p : {uneven_plate(), uneven_plate(1000, 1), uneven_plate(1e-12, 1e-12)}) {
    const linear_structure s = build(p, {}, {});
    linear_structure magnitudes = s;  // to measure the rounding in K u
    for (double& entry : magnitudes.stiffness.values) entry = std::abs(entry);
    REQUIRE(s.rigid_motions == 3);
    REQUIRE(s.rigid_rows.size() == static_cast<std::size_t>(p.dofs()));
    for (std::size_t motion = 0; motion < 3; ++motion) {
      std::vector<double> u;
      for (const rigid_row& row : s.rigid_rows) u.push_back(row[motion]);
      const auto force = multiply(s, u);
      for (double& x : u) x = std::abs(x);
      const auto rounding = multiply(magnitudes, u);
      for (std::size_t i = 0; i < u.size(); ++i) CHECK(std::abs(force[i]) <= 1e-14 * rounding[i]);
    }
    // The motions are a translation by 1, and rotations about the middle that lift the right edge or the
    // upper edge by 1.
    CHECK(s.rigid_rows.front() == rigid_row{1, -1, -1});
    CHECK(s.rigid_rows[s.rigid_rows.size() - 3] == rigid_row{1, 1, 1});
    const double half_x = (p.x.back() - p.x.front()) / 2;
    const double half_y = (p.y.back() - p.y.front()) / 2;
    CHECK(s.rigid_rows[1] == rigid_row{0, 1 / half_x, 0});
    CHECK(s.rigid_rows[2] == rigid_row{0, 0, 1 / half_y});
  }
}

TEST_CASE(
    "patch test: edge moments bend an uneven plate to constant curvatures, and corner forces twist it") {
  for (const double narrow : {1.0, 0.1, 10.0}) {
    const plate p = uneven_plate(1.0, narrow);
    for (const uniform_state& state : {bent_by(p, 3.0, -0.5), twisted_by(p, 0.7)})
      CHECK(difference(displaced(p, at_first_node, state.l), at_nodes(p, state.w)) < 1e-7);
  }
}

TEST_CASE(
    "patch test at an aspect ratio of 1:1000: constant curvature and twist need only forces at the edges") {
  for (const double narrow : {1.0 / 1024, 1024.0}) {
    // All numbers are exact in binary. Otherwise the rounding of w would give an error of eps aspect^4, 1e-3.
    const plate p{{0.0, 1.0, 2.5}, {0.0, narrow, 2.5 * narrow}, 2.0, 0.25};
    std::vector<support> all;
    for (int node = 0; node < p.nodes(); ++node) {
      for (int d = 0; d < 3; ++d) all.push_back({node, d, true});
    }
    // Moments are divided by an element's length.
    const std::array<double, 3> lever = {1.0, 1.0, narrow};
    for (const auto& [l, w] : {bent_by(p, 7.5, 1.875), bent_by(p, 1.875, 7.5), twisted_by(p, 1.5)}) {
      double applied = 0.0;
      for (const point_load& at : l.points) applied = std::max(applied, std::abs(at.value) / lever[at.dof]);
      const auto r = reactions(p, l, all, at_nodes(p, w));
      double worst = 0.0;
      for (std::size_t i = 0; i < r.size(); ++i) worst = std::max(worst, std::abs(r[i]) / lever[i % 3]);
      CHECK(worst < 1e-9 * applied);
      check_moments(p, w, 1e-12);
    }
  }
}

TEST_CASE("the corner moments of a plate are exact for cubic deflections and rigid-body motions") {
  check_moments(uneven_plate(), {{{1, 3, 0}, {2, 2, 1}, {-1, 0, 3}, {1, 3, 1}, {-2, 1, 3}}}, 1e-11);
  check_moments(loaded_quarter(10).p, {{{1000, 0, 0}, {3, 1, 0}, {-7, 0, 1}}}, 1e-8);
}

TEST_CASE("a simply supported square plate (PP1) converges to Navier's series as h^2, and sags") {
  for (const auto& [n, w, corner] : {std::tuple(4, 0.00412928, 0.05255),
                                     {8, 0.00407910, 0.06120},
                                     {16, 0.00406654, 0.06386},
                                     {24, 0.00406421, 0.06443}}) {
    const loaded_quarter q(n);
    CHECK(q.middle() == Approx(-w).margin(5e-9));
    CHECK(q.corner() == Approx(-corner).margin(5e-6));  // the support pulls the corner down
  }
  double navier = 0.0;
  for (int m = 1; m < 400; m += 2) {
    for (int n = 1; n < 400; n += 2) {
      const double sign = (m + n) / 2 % 2 == 1 ? 1.0 : -1.0;
      navier += sign * 16 / std::pow(std::numbers::pi, 6) / (m * n * std::pow(m * m + n * n, 2));
    }
  }
  CHECK(navier == Approx(0.00406235266).epsilon(1e-8));
  double before = 0.0;
  for (const int n : {4, 8, 16, 32}) {
    const double error = std::abs(-loaded_quarter(n).middle() - navier);
    if (before > 0.0) CHECK(before / error == Approx(4.0).epsilon(0.02));
    before = error;
  }
  CHECK(before / navier < 3e-4);
  const loaded_quarter square(8);
  CHECK(square.moment(0) == Approx(0.0479).epsilon(0.01));  // the tabulated 0.0479 q a^2
  CHECK(square.moment(1) == Approx(square.moment(0)).epsilon(1e-12));
}

TEST_CASE("a strip of a plate along x or along y bends like a beam") {
  // With nu = 0 and one end clamped, the strip bends like a beam with EI = D times its width.
  const double width = 0.5;
  for (const bool along_x : {true, false}) {
    plate p{even_beam(10.0, 40, 1.0).x, even_beam(width, 2, 1.0).x, 3.0, 0.0};
    if (!along_x) std::swap(p.x, p.y);
    const linear_structure s = build(p, {}, {});
    CHECK(s.stiffness.band().subdiagonals() == 14);
    CHECK(s.rows.empty() == !along_x);
    std::vector<support> clamp;
    load tip;
    for (int k = 0; k < 3; ++k) {
      const int root = along_x ? p.node_at(0, k) : p.node_at(k, 0);
      for (int d = 0; d < 3; ++d) clamp.push_back({root, d, true});
      tip.points.push_back({along_x ? p.node_at(40, k) : p.node_at(k, 40), 0, k == 1 ? -0.5 : -0.25});
    }
    const auto u = displaced(p, clamp, tip);
    const double EI = p.D * width;
    const auto end = std::size_t{3} * tip.points[1].node;
    CHECK(u[end] == Approx(-1000.0 / 3 / EI).epsilon(1e-8));
    CHECK(u[end + (along_x ? 1 : 2)] == Approx(-100.0 / 2 / EI).epsilon(1e-8));
    const auto r = reactions(p, tip, clamp, u);
    CHECK(r[0] + r[3] + r[6] == Approx(1.0).epsilon(1e-7));
    const std::size_t bending = along_x ? 1 : 2;
    CHECK(r[bending] + r[3 + bending] + r[6 + bending] == Approx(10.0).epsilon(1e-7));
  }
}

TEST_CASE("the dimensionless answer of a plate is the same in units of length from 1e-12 to 1e12") {
  const loaded_quarter one(6);
  for (const double unit : {1e-12, 1e-6, 1e6, 1e12}) {
    const loaded_quarter q(6, unit, 1e5);
    const double deflection = std::pow(unit, 4) / 1e5;
    CHECK(q.middle() / deflection == Approx(one.middle()).epsilon(1e-12));
    CHECK(q.u[4] / (deflection / unit) == Approx(one.u[4]).epsilon(1e-12));
    CHECK(q.corner() / unit / unit == Approx(one.corner()).epsilon(1e-10));
    CHECK(q.moment(0) / unit / unit == Approx(one.moment(0)).epsilon(1e-10));
  }
}

TEST_CASE("A pressure on any rectangle of a plate does exact work on cubic polynomials, x^3 y and x y^3") {
  const load l = rectangle(3.0, {-0.3, 1.3}, {0.25, 1.05});
  for (int m = 0; m <= 3; ++m) {
    for (int n = 0; n <= 3; ++n) {
      if (m + n > 4 || (m == 2 && n == 2)) continue;
      CAPTURE(m, n);
      CHECK(work_on(uneven_plate(), l, m, n) ==
            Approx(3.0 * 1.6 * 0.8 * mean(-0.3, 1.3, m) * mean(0.25, 1.05, n)).epsilon(1e-13));
    }
  }
  const resultant r = resultant_of(uneven_plate(), rectangle(0.5, {-0.3, 1.3}, {0.25, 1.05}));
  CHECK((r.force == 0.64 && r.moments.at(0) == 0.32 && r.moments.at(1) == 0.416));
}

TEST_CASE(
    "A moment over a rectangle of a plate does the work of the mean slope, for every cubic deflection") {
  for (const std::array<double, 2>& total : {std::array{3.0, 0.0}, {0.0, -2.0}, {3.0, -2.0}}) {
    const load l{{}, {}, {}, {}, "", {{load_kind::moment, -0.3, 1.3, {total[0], total[1]}, {0.25, 1.05}}}};
    for (int m = 0; m <= 3; ++m)
      for (int n = 0; n <= 3; ++n) {
        if (m + n > 3 && (m != 3 || n != 1) && (m != 1 || n != 3)) continue;
        CAPTURE(m, n);
        const double along_x = m == 0 ? 0 : m * mean(-0.3, 1.3, m - 1) * mean(0.25, 1.05, n);
        const double along_y = n == 0 ? 0 : n * mean(-0.3, 1.3, m) * mean(0.25, 1.05, n - 1);
        CHECK(work_on(uneven_plate(), l, m, n) ==
              Approx(total[0] * along_x + total[1] * along_y).epsilon(1e-13).margin(1e-13));
      }
    const resultant r = resultant_of(uneven_plate(), l);
    CHECK((r.force == 0 && r.moments.at(0) == total[0] && r.moments.at(1) == total[1]));
  }
}

TEST_CASE("A pressure on elements of a plate has its resultant, and equals one on a rectangle to the bit") {
  const plate p = uneven_plate();
  // The resultant: the force, and its moments. Element 4 is 0.3 by 0.3 with its middle at (0.35, 0.85).
  const std::pair<load, std::array<double, 3>> rows[] = {
      {{{}, {{{-2.0}, {}}}}, {-2.0 * 9, -2.0 * 9 * 0.5, -2.0 * 9 * 1.5}},
      {{{{0, 2, 5.0}}, {{{1.0}, {4}}, {{2.0}, {4}}}},
       {3.0 * 0.09, 3.0 * 0.09 * 0.35, 3.0 * 0.09 * 0.85 + 5.0}}};
  for (const auto& [l, expected] : rows)
    for (int i = 0; i < 3; ++i)
      CHECK(work_on(p, l, i == 1 ? 1 : 0, i == 2 ? 1 : 0) == Approx(expected[i]).epsilon(1e-14));
  // With half lengths a and b, a pressure q has the corner moments q a^2 b / 3 and q a b^2 / 3.
  CHECK(nodal_forces({{0, 2}, {0, 4}, 1.0, 0.3}, {{}, {{{1.0}, {}}}}) ==
        std::vector<double>{2, 2.0 / 3, 4.0 / 3, 2, -2.0 / 3, 4.0 / 3, 2, 2.0 / 3, -4.0 / 3, 2, -2.0 / 3,
                            -4.0 / 3});
  CHECK(nodal_forces(p, rectangle(-0.7, {0.2, 2.0}, {0.7, 1.1})) ==
        nodal_forces(p, {{}, {{{-0.7}, {4, 5, 7, 8}}}}));
  load cancels = rectangle(0.1, {-1.0, 0.3}, {0.0, 0.9});  // as decimals
  cancels.placed.push_back(rectangle(0.1, {0.3, 2.0}, {0.0, 0.9}).placed[0]);
  cancels.placed.push_back(rectangle(0.1, {-1.0, 2.0}, {0.9, 3.0}).placed[0]);
  cancels.distributed.push_back({{-0.1}, {}});
  CHECK(nodal_forces(p, cancels) == std::vector<double>(p.dofs(), 0.0));
}

TEST_CASE("a plate refuses a pressure that is a polynomial in x") {
  CHECK_THROWS_AS(nodal_forces(uneven_plate(), {{}, {{{1.0, 2.0}, {}}}}), std::invalid_argument);
}

TEST_CASE("the reactions of a plate balance loads at fixed corners, edges and inner nodes, and at springs") {
  const plate p = uneven_plate();
  std::vector<support> supports = {{p.node_at(0, 0), 0, true},       {p.node_at(3, 0), 0, true},
                                   {p.node_at(1, 2), 0, true},       {p.node_at(1, 2), 2, true},
                                   {p.node_at(3, 4), 0, false, 4.0}, {p.node_at(2, 4), 1, false, 7.0},
                                   {p.node_at(0, 3), 2, false, 2.0}, {p.node_at(0, 0), 0, true}};
  const load l{{{p.node_at(3, 0), 0, -4.0}, {p.node_at(0, 4), 0, -1.0}, {p.node_at(3, 3), 1, 0.5}},
               {{{-1.0}, {}}, {{-3.0}, {2, 5}}}};
  const auto u = displaced(p, supports, l);
  const auto r = reactions(p, l, supports, u);
  REQUIRE(r.size() == supports.size());
  CHECK(r.back() == 0.0);  // the dof is already fixed by the first support
  std::vector<double> f = nodal_forces(p, l);
  for (std::size_t i = 0; i < supports.size(); ++i) f[3 * supports[i].node + supports[i].dof] += r[i];
  const auto needed = multiply(build(p, {}, {}), u);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK(f[i] == Approx(needed[i]).margin(1e-10));
  CHECK(r[4] == -4.0 * u[std::size_t{3} * p.node_at(3, 4)]);
  CHECK(std::abs(r[3]) > 0.01);
}

TEST_CASE(
    "a plate whose stiffness exceeds the range of doubles is refused, and the message names the element") {
  const plate p{{0.0, 1e-100, (1.0 + 1e-12) * 1e-100}, {0.0, 0.25, 0.5}, 1.0, 0.3};
  CHECK_THROWS_WITH(build(p, {}, {}), Catch::Matchers::Contains("element 2"));
}

TEST_CASE("three points that are not on one line hold a plate, and so does a point with two slopes") {
  const plate p = uneven_plate(1e9, 1e-9);
  const auto rank_of = [&](const std::vector<support>& supports, const std::vector<contact_pair>& pairs) {
    const linear_structure s = build(p, supports, pairs);
    return s.held_by([](std::size_t) { return true; }).rank();
  };
  const contact_pair stop{p.node_at(2, 3), -1, 0.0, 1.0, true};
  CHECK(rank_of(at_first_node, {}) == 3);
  CHECK(rank_of({{0, 0, true}, {p.node_at(1, 0), 0, true}, {p.node_at(3, 0), 0, false, 1.0}}, {}) == 2);
  CHECK(rank_of({{0, 0, true}, {p.node_at(3, 0), 0, true}}, {stop}) == 3);
  CHECK(rank_of({{0, 1, true}, {5, 1, true}, {7, 2, true}}, {}) == 2);
  CHECK(rank_of({{0, 1, true}, {5, 1, true}, {7, 2, true}}, {stop}) == 3);
  CHECK(build(p, {}, {stop}).pairs[0].dof == 3 * p.node_at(2, 3));
}

TEST_CASE("the stiffness D of a plate is correct to 32 digits, even if 1 - nu^2 cancels in doubles") {
  const plate p{{0, 1}, {0, 1}, 1.0, -0.9999999999999999, 2484, 0.1};
  // 1 - nu^2 = 1e-16 (2 - 1e-16), and D = 0.207 / (1 - nu^2).
  const auto D = stiffness_of<double_double>(p);
  const auto nu_off = number_of<double_double>(1e-16);
  CHECK(std::abs((D * nu_off * (2 - nu_off) - number_of<double_double>(0.207)).hi) < 1e-30);
  CHECK(std::abs(bending_stiffness(p.E, p.nu, p.thickness) / D.hi - 1) > 0.05);
}
