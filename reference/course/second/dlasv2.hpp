// DLASV2 of LAPACK 3.11.0 in C++, operation for operation: the singular value decomposition of [f g; 0 h].
#pragma once

#include <array>
#include <cmath>
#include <utility>

/// SSMIN, SSMAX, SNR, CSR, SNL, CSL, in the order of the FORTRAN arguments.
using dlasv2_answer = std::array<double, 6>;

[[nodiscard]] inline dlasv2_answer dlasv2(double f, double g, double h) {
  constexpr double eps = 0x1p-53;  // DLAMCH('EPS'): half of C's DBL_EPSILON
  const auto sign = [](double a, double b) { return std::copysign(a, b); };  // of -0.0: minus, as SIGN
  double ft = f, fa = std::abs(ft), ht = h, ha = std::abs(h);
  int pmax = 1;
  const bool swap = ha > fa;
  if (swap) {
    pmax = 3;
    std::swap(ft, ht);
    std::swap(fa, ha);
  }
  const double gt = g, ga = std::abs(gt);
  double ssmin, ssmax, clt = 1, crt = 1, slt = 0, srt = 0;
  if (ga == 0) {
    ssmin = ha;
    ssmax = fa;
  } else {
    bool gasmal = true;
    if (ga > fa) {
      pmax = 2;
      if (fa / ga < eps) {
        gasmal = false;
        ssmax = ga;
        ssmin = ha > 1 ? fa / (ga / ha) : (fa / ga) * ha;
        clt = srt = 1;
        slt = ht / gt;
        crt = ft / gt;
      }
    }
    if (gasmal) {
      const double d = fa - ha;
      double l = d == fa ? 1 : d / fa;  // an infinite f or h has no quotient
      const double m = gt / ft;
      double t = 2 - l;
      const double mm = m * m, tt = t * t;
      const double s = std::sqrt(tt + mm);
      const double r = l == 0 ? std::abs(m) : std::sqrt(l * l + mm);
      const double a = 0.5 * (s + r);
      ssmin = ha / a;
      ssmax = fa * a;
      if (mm == 0) {
        t = l == 0 ? sign(2, ft) * sign(1, gt) : gt / sign(d, ft) + m / t;
      } else {
        t = (m / (s + t) + m / (r + l)) * (1 + a);
      }
      l = std::sqrt(t * t + 4);
      crt = 2 / l;
      srt = t / l;
      clt = (crt + srt * m) / a;
      slt = (ht / ft) * srt / a;
    }
  }
  const double csl = swap ? srt : clt, snl = swap ? crt : slt, csr = swap ? slt : crt, snr = swap ? clt : srt;
  double tsign = sign(1, csr) * sign(1, csl) * sign(1, f);
  if (pmax == 2) tsign = sign(1, snr) * sign(1, csl) * sign(1, g);
  if (pmax == 3) tsign = sign(1, snr) * sign(1, snl) * sign(1, h);
  return {sign(ssmin, tsign * sign(1, f) * sign(1, h)), sign(ssmax, tsign), snr, csr, snl, csl};
}
