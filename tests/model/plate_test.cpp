// Tests Adini-Clough-Melosh plates against fields that they reproduce exactly, and against Navier's series.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "catch.hpp"
#include "contct/model/line.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

std::vector<double> even_lines(double length, int elements) {
  std::vector<double> lines;
  for (int i = 0; i <= elements; ++i) lines.push_back(length * i / elements);
  return lines;
}

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

/// A deflection field and its slopes along x and y.
struct field {
  std::function<double(double, double)> w, wx, wy;
};

std::vector<double> at_nodes(const plate& p, const field& of) {
  std::vector<double> u;
  for (const double y : p.y) {
    for (const double x : p.x) u.insert(u.end(), {of.w(x, y), of.wx(x, y), of.wy(x, y)});
  }
  return u;
}

element_results moments_in(const plate& p, const field& of) {
  return results_in_elements(p, {}, at_nodes(p, of));
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

/// Returns moments along the edges that bend the plate to M_x and M_y everywhere without other loads.
load edge_moments(const plate& p, double m_x, double m_y) {
  load l;
  const int right = p.columns() - 1;
  const int top = p.rows() - 1;
  const auto share = [](const std::vector<double>& lines, int i) {
    return (lines[std::min(i + 1, static_cast<int>(lines.size()) - 1)] - lines[std::max(i - 1, 0)]) / 2;
  };
  for (int j = 0; j <= top; ++j) {
    l.points.push_back({p.node_at(0, j), 1, -m_x * share(p.y, j)});
    l.points.push_back({p.node_at(right, j), 1, m_x * share(p.y, j)});
  }
  for (int i = 0; i <= right; ++i) {
    l.points.push_back({p.node_at(i, 0), 2, -m_y * share(p.x, i)});
    l.points.push_back({p.node_at(i, top), 2, m_y * share(p.x, i)});
  }
  return l;
}

/// Returns the deflection under uniform moments m_x and m_y, with w = wx = wy = 0 at the first node.
field bent_by(const plate& p, double m_x, double m_y) {
  const double stiff = p.D * (1 - p.nu * p.nu);
  const double k_x = (m_x - p.nu * m_y) / stiff;
  const double k_y = (m_y - p.nu * m_x) / stiff;
  const double x0 = p.x[0];
  const double y0 = p.y[0];
  return {[=](double x, double y) { return k_x * (x - x0) * (x - x0) / 2 + k_y * (y - y0) * (y - y0) / 2; },
          [=](double x, double) { return k_x * (x - x0); }, [=](double, double y) { return k_y * (y - y0); }};
}

/// Returns corner forces of 2 M_xy, under which a free plate has the twisting moment M_xy everywhere.
load corner_forces(const plate& p, double m_xy) {
  const int right = p.columns() - 1;
  const int top = p.rows() - 1;
  return {{{p.node_at(0, 0), 0, 2 * m_xy},
           {p.node_at(right, 0), 0, -2 * m_xy},
           {p.node_at(right, top), 0, 2 * m_xy},
           {p.node_at(0, top), 0, -2 * m_xy}},
          {}};
}

field twisted_by(const plate& p, double m_xy) {
  const double twist = m_xy / p.D / (1 - p.nu);
  const double x0 = p.x[0];
  const double y0 = p.y[0];
  return {[=](double x, double y) { return twist * (x - x0) * (y - y0); },
          [=](double, double y) { return twist * (y - y0); },
          [=](double x, double) { return twist * (x - x0); }};
}

/// Returns supports of w, wx and wy at the lower left node only.
std::vector<support> held_at_first_node() {
  return {{0, 0, true}, {0, 1, true}, {0, 2, true}};
}

/// Returns a quarter of PP1's square plate of side 1, without supports.
plate quarter_of_square(int n) {
  return {even_lines(0.5, n), even_lines(0.5, n), 1.0, 0.3};
}

/// Returns supports of w and of the slope along the edges x = 0 and y = 0, and symmetry at the other two
/// edges.
std::vector<support> simply_supported_quarter(const plate& p) {
  const int n = p.columns() - 1;
  std::vector<support> s;
  for (int i = 0; i <= n; ++i) {
    for (const int node : {p.node_at(0, i), p.node_at(i, 0)}) s.push_back({node, 0, true});
    s.push_back({p.node_at(0, i), 2, true});
    s.push_back({p.node_at(i, 0), 1, true});
    s.push_back({p.node_at(n, i), 1, true});
    s.push_back({p.node_at(i, n), 2, true});
  }
  return s;
}

const load unit_pressure_down{{}, {{{-1.0}, {}}}};

/// Returns `s` with the absolute values of K, to measure the rounding in K u.
linear_structure magnitudes(linear_structure s) {
  const std::size_t entries =
      static_cast<std::size_t>(s.dofs()) * static_cast<std::size_t>(s.stiffness.band().subdiagonals() + 1);
  for (std::size_t i = 0; i < entries; ++i)
    s.stiffness.band().data()[i] = std::abs(s.stiffness.band().data()[i]);
  return s;
}

}  // namespace

TEST_CASE("the three rigid-body motions of a plate need no force") {
  for (const plate& p : {uneven_plate(), uneven_plate(1000, 1), uneven_plate(1e-12, 1e-12)}) {
    const linear_structure s = build(p, {}, {});
    const linear_structure of_signs = magnitudes(s);
    REQUIRE(s.rigid_motions == 3);
    REQUIRE(s.rigid_rows.size() == static_cast<std::size_t>(p.dofs()));
    for (std::size_t motion = 0; motion < 3; ++motion) {
      std::vector<double> u;
      for (const rigid_row& row : s.rigid_rows) u.push_back(row[motion]);
      const auto force = multiply(s, u);
      for (double& x : u) x = std::abs(x);
      const auto rounding = multiply(of_signs, u);
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
    const auto bent = displaced(p, held_at_first_node(), edge_moments(p, 3.0, -0.5));
    CHECK(difference(bent, at_nodes(p, bent_by(p, 3.0, -0.5))) < 1e-7);
    const auto twisted = displaced(p, held_at_first_node(), corner_forces(p, 0.7));
    CHECK(difference(twisted, at_nodes(p, twisted_by(p, 0.7))) < 1e-7);
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
    // Returns the largest reaction relative to the largest load. Moments are divided by an element's length.
    const std::array<double, 3> lever = {1.0, 1.0, narrow};
    const auto excess = [&](const field& f, const load& l) {
      double applied = 0.0;
      for (const point_load& at : l.points) applied = std::max(applied, std::abs(at.value) / lever[at.dof]);
      const auto r = reactions(p, l, all, at_nodes(p, f));
      double worst = 0.0;
      for (std::size_t i = 0; i < r.size(); ++i) worst = std::max(worst, std::abs(r[i]) / lever[i % 3]);
      return worst / applied;
    };
    CHECK(excess(bent_by(p, 7.5, 1.875), edge_moments(p, 7.5, 1.875)) < 1e-9);
    CHECK(excess(bent_by(p, 1.875, 7.5), edge_moments(p, 1.875, 7.5)) < 1e-9);
    CHECK(excess(twisted_by(p, 1.5), corner_forces(p, 1.5)) < 1e-9);
    const element_results bent = moments_in(p, bent_by(p, 7.5, 1.875));
    const element_results twisted = moments_in(p, twisted_by(p, 1.5));
    for (std::size_t e = 0; e < 4; ++e) {
      for (std::size_t k = 0; k < 4; ++k) {
        CHECK(bent.at(e, 0)[k] == Approx(7.5).epsilon(1e-12));
        CHECK(bent.at(e, 1)[k] == Approx(1.875).epsilon(1e-12));
        CHECK(bent.at(e, 2)[k] == Approx(0.0).margin(1e-12));
        CHECK(twisted.at(e, 2)[k] == Approx(1.5).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("the corner moments of a plate are exact for cubic deflections, and positive for sagging") {
  const plate p = uneven_plate();
  const field w = {[](double x, double y) {
                     return x * x * x + 2 * x * x * y - y * y * y + x * x * x * y - 2 * x * y * y * y;
                   },
                   [](double x, double y) { return 3 * x * x + 4 * x * y + 3 * x * x * y - 2 * y * y * y; },
                   [](double x, double y) { return 2 * x * x - 3 * y * y + x * x * x - 6 * x * y * y; }};
  const element_results moments = moments_in(p, w);
  REQUIRE(moments.elements() == 12);
  for (std::size_t e = 0; e < 12; ++e) {
    const auto corners = p.corners_of(static_cast<int>(e));
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = p.x[corners[k] % p.columns()];
      const double y = p.y[corners[k] / p.columns()];
      const double xx = 6 * x + 4 * y + 6 * x * y;
      const double yy = -6 * y - 12 * x * y;
      const double xy = 4 * x + 3 * x * x - 6 * y * y;
      CHECK(moments.at(e, 0)[k] == Approx(p.D * (xx + p.nu * yy)).margin(1e-11));
      CHECK(moments.at(e, 1)[k] == Approx(p.D * (yy + p.nu * xx)).margin(1e-11));
      CHECK(moments.at(e, 2)[k] == Approx(p.D * (1 - p.nu) * xy).margin(1e-11));
    }
  }
  // A plate on simple supports sags under a pressure.
  const plate square = quarter_of_square(8);
  const element_results sag = results_in_elements(
      square, {}, displaced(square, simply_supported_quarter(square), unit_pressure_down));
  CHECK(sag.at(63, 0)[2] == Approx(0.0479).epsilon(0.01));  // the tabulated 0.0479 q a^2
  CHECK(sag.at(63, 1)[2] == Approx(sag.at(63, 0)[2]).epsilon(1e-12));
}

TEST_CASE("a rigid-body motion of any size gives a plate no moments") {
  const plate p = quarter_of_square(10);
  const field far = {[](double x, double y) { return 1000 + 3 * x - 7 * y; },
                     [](double, double) { return 3.0; }, [](double, double) { return -7.0; }};
  const element_results moments = moments_in(p, far);
  REQUIRE(moments.values.size() == 1200);
  for (const double moment : moments.values) CHECK(std::abs(moment) < 1e-8);
}

TEST_CASE(
    "a quarter of a simply supported square plate (PP1) has the expected deflections and corner forces") {
  struct expected {
    int n;
    double w, corner;
  };
  for (const expected& e : {expected{4, 0.00412928, 0.05255}, expected{8, 0.00407910, 0.06120},
                            expected{16, 0.00406654, 0.06386}, expected{24, 0.00406421, 0.06443}}) {
    const plate p = quarter_of_square(e.n);
    const auto supports = simply_supported_quarter(p);
    const auto u = displaced(p, supports, unit_pressure_down);
    CHECK(u[u.size() - 3] == Approx(-e.w).margin(5e-9));
    const auto r = reactions(p, unit_pressure_down, supports, u);
    CHECK(r[0] == Approx(-e.corner).margin(5e-6));  // the support pulls the corner down
  }
}

TEST_CASE("the deflection of a plate with elements of size h converges to Navier's series as h^2") {
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
    const plate p = quarter_of_square(n);
    const auto u = displaced(p, simply_supported_quarter(p), unit_pressure_down);
    const double error = std::abs(-u[u.size() - 3] - navier);
    if (before > 0.0) CHECK(before / error == Approx(4.0).epsilon(0.02));
    before = error;
  }
  CHECK(before / navier < 3e-4);
}

TEST_CASE("a strip of a plate along x or along y bends like a beam") {
  // With nu = 0 and one end clamped, the strip bends like a beam with EI = D times its width.
  const double width = 0.5;
  for (const bool along_x : {true, false}) {
    plate p{even_lines(10.0, 40), even_lines(width, 2), 3.0, 0.0};
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
  const plate one = quarter_of_square(6);
  const auto u = displaced(one, simply_supported_quarter(one), unit_pressure_down);
  for (const double unit : {1e-12, 1e-6, 1e6, 1e12}) {
    plate p = one;
    for (double& x : p.x) x *= unit;
    for (double& y : p.y) y *= unit;
    p.D = 1e5;
    const auto supports = simply_supported_quarter(p);
    const auto v = displaced(p, supports, unit_pressure_down);
    const double deflection = std::pow(unit, 4) / p.D;
    CHECK(v[v.size() - 3] / deflection == Approx(u[u.size() - 3]).epsilon(1e-12));
    CHECK(v[4] / (deflection / unit) == Approx(u[4]).epsilon(1e-12));
    const double corner = reactions(p, unit_pressure_down, supports, v)[0] / unit / unit;
    CHECK(corner == Approx(reactions(one, unit_pressure_down, supports, u)[0]).epsilon(1e-10));
    CHECK(results_in_elements(p, {}, v).at(35, 0)[2] / unit / unit ==
          Approx(results_in_elements(one, {}, u).at(35, 0)[2]).epsilon(1e-10));
  }
}

TEST_CASE(
    "the nodal forces of a pressure on some elements of a plate have the resultant and moments of the "
    "pressure") {
  const plate p = uneven_plate();
  const auto resultant = [&](const load& l) {
    std::vector<double> f(p.dofs(), 0.0);
    add_consistent_loads(p, l, f);
    std::array<double, 3> sum{};
    for (int node = 0; node < p.nodes(); ++node) {
      const auto i = std::size_t{3} * node;
      sum[0] += f[i];
      sum[1] += f[i] * p.x[node % p.columns()] + f[i + 1];
      sum[2] += f[i] * p.y[node / p.columns()] + f[i + 2];
    }
    return sum;
  };
  const auto whole = resultant({{}, {{{-2.0}, {}}}});
  CHECK(whole[0] == Approx(-2.0 * 9).epsilon(1e-14));
  CHECK(whole[1] == Approx(-2.0 * 9 * 0.5).epsilon(1e-14));
  CHECK(whole[2] == Approx(-2.0 * 9 * 1.5).epsilon(1e-14));
  // Element 4 is 0.3 by 0.3 with its middle at (0.35, 0.85).
  const auto part = resultant({{{0, 2, 5.0}}, {{{1.0}, {4}}, {{2.0}, {4}}}});
  CHECK(part[0] == Approx(3.0 * 0.09).epsilon(1e-14));
  CHECK(part[1] == Approx(3.0 * 0.09 * 0.35).epsilon(1e-14));
  CHECK(part[2] == Approx(3.0 * 0.09 * 0.85 + 5.0).epsilon(1e-14));
  // With half lengths a and b, a pressure q has the corner moments q a^2 b / 3 and q a b^2 / 3.
  std::vector<double> f(12, 0.0);
  add_consistent_loads(plate{{0, 2}, {0, 4}, 1.0, 0.3}, {{}, {{{1.0}, {}}}}, f);
  CHECK(f == std::vector<double>{2, 2.0 / 3, 4.0 / 3, 2, -2.0 / 3, 4.0 / 3, 2, 2.0 / 3, -4.0 / 3, 2, -2.0 / 3,
                                 -4.0 / 3});
}

TEST_CASE("a plate refuses a pressure that is a polynomial in x") {
  const plate p = uneven_plate();
  std::vector<double> f(p.dofs(), 0.0);
  CHECK_THROWS_AS(add_consistent_loads(p, {{}, {{{1.0, 2.0}, {}}}}, f), std::invalid_argument);
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
  std::vector<double> f(u.size(), 0.0);
  add_consistent_loads(p, l, f);
  for (std::size_t i = 0; i < supports.size(); ++i) f[3 * supports[i].node + supports[i].dof] += r[i];
  const auto needed = multiply(build(p, {}, {}), u);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK(f[i] == Approx(needed[i]).margin(1e-10));
  CHECK(r[4] == -4.0 * u[std::size_t{3} * p.node_at(3, 4)]);
  CHECK(std::abs(r[3]) > 0.01);
}

TEST_CASE("E, nu and thickness give a plate the stiffness D = E t^3 / 12 (1 - nu^2)") {
  CHECK(bending_stiffness(10.92, 0.3, 1.0) == Approx(1.0).epsilon(1e-15));
  CHECK(bending_stiffness(12.0, 0.0, 2.0) == 8.0);
}

TEST_CASE(
    "a plate whose stiffness exceeds the range of doubles is refused, and the message names the element") {
  plate p = quarter_of_square(2);
  p.x = {0.0, 1.0, 1.0 + 1e-12};
  for (double& x : p.x) x *= 1e-100;
  CHECK_THROWS_WITH(build(p, {}, {}), Catch::Matchers::Contains("element 2"));
}

TEST_CASE("three points that are not on one line hold a plate, and so does a point with two slopes") {
  const plate p = uneven_plate(1e9, 1e-9);
  const auto rank_of = [&](const std::vector<support>& supports, const std::vector<contact_pair>& pairs) {
    const linear_structure s = build(p, supports, pairs);
    return s.held_by([](std::size_t) { return true; }).rank();
  };
  const contact_pair stop{p.node_at(2, 3), -1, 0.0, 1.0, true};
  CHECK(rank_of(held_at_first_node(), {}) == 3);
  CHECK(rank_of({{0, 0, true}, {p.node_at(1, 0), 0, true}, {p.node_at(3, 0), 0, false, 1.0}}, {}) == 2);
  CHECK(rank_of({{0, 0, true}, {p.node_at(3, 0), 0, true}}, {stop}) == 3);
  CHECK(rank_of({{0, 1, true}, {5, 1, true}, {7, 2, true}}, {}) == 2);
  CHECK(rank_of({{0, 1, true}, {5, 1, true}, {7, 2, true}}, {stop}) == 3);
  CHECK(build(p, {}, {stop}).dof_of_pair(0) == 3 * p.node_at(2, 3));
}

TEST_CASE("the stiffness D of a plate is correct to 32 digits, even if 1 - nu^2 cancels in doubles") {
  const plate p{{0, 1}, {0, 1}, 1.0, -0.9999999999999999, 2484, 0.1};
  // 1 - nu^2 = 1e-16 (2 - 1e-16), and D = 0.207 / (1 - nu^2).
  const auto D = stiffness_of<double_double>(p);
  const auto nu_off = number_of<double_double>(1e-16);
  CHECK(std::abs((D * nu_off * (2 - nu_off) - number_of<double_double>(0.207)).hi) < 1e-30);
  CHECK(std::abs(bending_stiffness(p.E, p.nu, p.thickness) / D.hi - 1) > 0.05);
}
