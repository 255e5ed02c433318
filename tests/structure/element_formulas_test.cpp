#include "contct/structure/element_formulas.hpp"

#include "catch.hpp"

namespace formulas = contct::structure::formulas;

namespace {

using vector12 = std::array<double, 12>;

/// 1.5 by 1.
constexpr struct { double a = 0.75, b = 0.5, D = 12.0, nu = 0.3; } element;

vector12 forces_at(const vector12& u) {
  return formulas::plate_forces(element.a, element.b, element.D, element.nu, u);
}

auto curvatures_at(const vector12& u) {
  return formulas::curvatures_at_corners(element.a, element.b,
                                         formulas::plate_deformation(element.a, element.b, u));
}

/// The dofs of w = f(x, y) with slopes fx and fy, at the corners (-a, -b), (a, -b), (a, b), (-a, b).
template <class W, class Wx, class Wy>
vector12 at_corners(W f, Wx fx, Wy fy) {
  vector12 u{};
  const double x[4] = {-element.a, element.a, element.a, -element.a};
  const double y[4] = {-element.b, -element.b, element.b, element.b};
  for (std::size_t k = 0; k < 4; ++k) {
    u[3 * k] = f(x[k], y[k]);
    u[3 * k + 1] = fx(x[k], y[k]);
    u[3 * k + 2] = fy(x[k], y[k]);
  }
  return u;
}

double work_of(const vector12& a, const vector12& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 12; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

TEST_CASE("the stiffness of an element is symmetric, and rigid motions need no force") {
  const auto k = formulas::plate_stiffness(element.a, element.b, element.D, element.nu);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK(k[i][j] == Approx(k[j][i]).margin(1e-12));
  const auto tilt = at_corners([](double x, double y) { return 1 + 2 * x - 3 * y; },
                               [](double, double) { return 2; }, [](double, double) { return -3; });
  for (const double force : forces_at(tilt)) CHECK(std::abs(force) <= 1e-12);
}

TEST_CASE(
    "bent to w = x^2 / 2 and twisted to w = x y, an element has the curvatures and the energy of that") {
  const auto bent = at_corners([](double x, double) { return x * x / 2; }, [](double x, double) { return x; },
                               [](double, double) { return 0; });
  for (const auto& c : curvatures_at(bent)) {
    CHECK(c.xx == Approx(1.0));
    CHECK(c.yy == Approx(0.0).margin(1e-13));
    CHECK(c.xy == Approx(0.0).margin(1e-13));
  }
  const double area = 4 * element.a * element.b;
  CHECK(work_of(bent, forces_at(bent)) == Approx(element.D * area));  // D w_xx^2
  const auto twisted = at_corners([](double x, double y) { return x * y; },
                                  [](double, double y) { return y; }, [](double x, double) { return x; });
  for (const auto& c : curvatures_at(twisted)) CHECK(c.xy == Approx(1.0));
  CHECK(work_of(twisted, forces_at(twisted)) ==
        Approx(2 * (1 - element.nu) * element.D * area));  // 2 D (1 - nu) w_xy^2
}

TEST_CASE("a unit pressure does the work of its resultant: area times height, none by tilting") {
  const vector12 f = formulas::plate_unit_load(element.a, element.b);
  const auto flat = at_corners([](double, double) { return 1; }, [](double, double) { return 0; },
                               [](double, double) { return 0; });
  CHECK(work_of(f, flat) == Approx(4 * element.a * element.b));
  const auto tilt = at_corners([](double x, double y) { return x + y; }, [](double, double) { return 1; },
                               [](double, double) { return 1; });
  CHECK(work_of(f, tilt) == Approx(0.0).margin(1e-14));
}
