#include <cmath>
#include <string>

#include "catch.hpp"
#include "contct/numeric/random.hpp"

extern "C" {
// The machine's LAPACK.
double dlamch_(const char* what, std::size_t length);
double dnrm2_(const int* n, const double* x, const int* incx);
void dlassq_(const int* n, const double* x, const int* incx, double* scale, double* sum);
void dlartg_(const double* f, const double* g, double* c, double* s, double* r);
// cpp/playground/lapack_rest.c
double rest_dlamch_(const char* what, int length);
double rest_dnrm2_(const int* n, const double* x, const int* incx);
void rest_dlassq_(const int* n, const double* x, const int* incx, double* scale, double* sum);
void rest_dlartg_(const double* f, const double* g, double* c, double* s, double* r);
double rest_d_sign(const double* a, const double* b);
int rest_i_dnnt(const double* x);
int rest_i_nint(const float* x);
void rest_s_copy(char* to, const char* from, int room, int length);
int rest_s_cmp(const char* a, const char* b, int length_a, int length_b);
}

namespace {

using contct::numeric::random_numbers;

/// An optimised BLAS adds in another order.
bool near(double x, double y) {
  return x == y || std::abs(x - y) <= 1e-15 * std::abs(y);
}

double any_number(random_numbers& random, int exponents) {
  const double x = std::ldexp(random.unit() + 0.5, random.whole(-exponents, exponents));
  return random.chance(0.1) ? 0.0 : random.chance(0.5) ? x : -x;
}

int of_length(std::string_view a, std::string_view b) {
  return rest_s_cmp(a.data(), b.data(), static_cast<int>(a.size()), static_cast<int>(b.size()));
}

}  // namespace

TEST_CASE("the page's machine constants are LAPACK's") {
  for (const char* what : {"E", "S", "B", "P", "N", "R", "M", "U", "L", "O", "e", "s"}) {
    INFO(what);
    CHECK(rest_dlamch_(what, 1) == dlamch_(what, 1));
  }
}

TEST_CASE("the page's norms and rotations are LAPACK's, near overflow and underflow as well") {
  random_numbers random(1989);
  for (const int exponents : {3, 30, 400, 1000}) {
    for (int i = 0; i < 1000; ++i) {
      double x[24];
      for (double& entry : x) entry = any_number(random, exponents);
      const int n = random.whole(0, 8), stride = random.whole(1, 3);
      CAPTURE(exponents, i, n, stride);
      REQUIRE(near(rest_dnrm2_(&n, x, &stride), dnrm2_(&n, x, &stride)));
      double scale[] = {1.0, 1.0}, sum[] = {2.0, 2.0};
      rest_dlassq_(&n, x, &stride, &scale[0], &sum[0]);
      dlassq_(&n, x, &stride, &scale[1], &sum[1]);
      REQUIRE(near(scale[0] * std::sqrt(sum[0]), scale[1] * std::sqrt(sum[1])));
      double c[2], s[2], r[2];
      rest_dlartg_(&x[0], &x[1], &c[0], &s[0], &r[0]);
      dlartg_(&x[0], &x[1], &c[1], &s[1], &r[1]);
      for (const double* const both : {c, s, r}) REQUIRE(near(both[0], both[1]));
    }
  }
}

TEST_CASE("the page's texts and whole numbers are Fortran's") {
  CHECK(of_length("ab", "ab   ") == 0);
  CHECK(of_length("", "   ") == 0);
  CHECK(of_length("ab", "ac") < 0);
  CHECK(of_length("b", "ab") > 0);
  CHECK(of_length("ab", "abc") < 0);
  char text[] = "......";
  rest_s_copy(text, "ab", 5, 2);
  CHECK(std::string(text) == "ab   .");
  rest_s_copy(text, "abcdef", 3, 6);
  CHECK(std::string(text) == "abc  .");
  const double three = 3.0, minus_zero = -0.0, half = 2.5, minus_half = -2.5;
  const float small = 0.4F;
  CHECK(rest_d_sign(&three, &minus_zero) == -3.0);
  CHECK(rest_i_dnnt(&half) == 3);
  CHECK(rest_i_dnnt(&minus_half) == -3);
  CHECK(rest_i_nint(&small) == 0);
}
