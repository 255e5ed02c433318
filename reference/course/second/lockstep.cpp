// lockstep RECORD: DLASV2 in FORTRAN and its port get the same calls, compared to the bit. The first calls
// with FORTRAN's answers go to RECORD. Exit status 1 where an answer differs.
#include <dlasv2.hpp>  // in angle brackets: a planted fault comes first in the include path
#include <fstream>
#include <iostream>

#include "contct/harness/compare.hpp"
#include "contct/number/double_double.hpp"
#include "contct/number/random.hpp"

using namespace contct;
extern "C" void dlasv2_(const double* f, const double* g, const double* h, double* ssmin, double* ssmax,
                        double* snr, double* csr, double* snl, double* csl);

namespace {
constexpr int calls_of_a_kind = 200000, recorded_of_a_kind = 1000;
constexpr double inf = INFINITY, nan = NAN;
constexpr std::array names = {"SSMIN", "SSMAX", "SNR", "CSR", "SNL", "CSL"};
struct inputs {
  double f, g, h;
};

/// With F and SSMIN in one variable where `aliased`, which FORTRAN's comment allows.
dlasv2_answer fortran(inputs in, bool aliased = false) {
  dlasv2_answer o;
  double& ssmin = aliased ? in.f : o[0];
  dlasv2_(&in.f, &in.g, &in.h, &ssmin, &o[1], &o[2], &o[3], &o[4], &o[5]);
  o[0] = ssmin;
  return o;
}

double any(random_numbers& r, int exponent) {
  return std::ldexp(r.chance(0.5) ? 1 + r.unit() : -1 - r.unit(), r.whole(-exponent, exponent));
}
inputs random_call(random_numbers& r) {
  return {any(r, 3), any(r, 3), any(r, 3)};
}

/// x or a number at most two representable numbers from it, of either sign.
double near(random_numbers& r, double x) {
  for (int n = r.whole(0, 2); n > 0; --n) x = std::nextafter(x, r.chance(0.5) ? inf : -inf);
  return r.chance(0.5) ? x : -x;
}

/// A call beside a comparison, sometimes with a zero, an infinity, a NaN or an extreme number in it.
inputs aimed_call(random_numbers& r) {
  static constexpr std::array special = {
      0.0, -0.0, 1.0, -1.0, inf, -inf, nan, -nan, 0x1p-1074, -0x1p-1022, 0x1.fffffffffffffp+1023};
  inputs in{any(r, 20), any(r, 20), any(r, 20)};
  const int kind = r.whole(0, 6);
  if (kind == 0) in = {near(r, in.g * 0x1p-53), in.g, in.g * 0x1p-53 * r.unit()};   // FA/GA and EPS
  if (kind == 1) in.h = near(r, in.f);                                              // HA and FA
  if (kind == 2) in = {1 + 0x1p20 * r.unit(), std::ldexp(in.g, 99), near(r, 1)};    // HA and 1, G is large
  if (kind == 3) in.h = std::ldexp(near(r, in.f), -r.whole(52, 55));                // D and FA
  if (kind == 4) in = {in.f, std::ldexp(in.g, -r.whole(500, 600)), near(r, in.f)};  // MM and 0
  if (kind == 5) in.g = near(r, in.f);                                              // GA and FA
  if (kind == 6)
    in = {std::ldexp(in.f, 1000), std::ldexp(in.g, -1040), std::ldexp(in.h, r.whole(-1050, 1000))};
  for (double* x : {&in.f, &in.g, &in.h}) {
    if (r.chance(0.1)) *x = special[static_cast<std::size_t>(r.whole(0, special.size() - 1))];
  }
  return in;
}

/// Largest relative residual, in 32 digits, of U' A V, of which SSMIN and SSMAX are the diagonal, and of F*H.
double residual(const inputs& in, const dlasv2_answer& o) {
  using dd = double_double;
  const auto [ssmin, ssmax, snr, csr, snl, csl] = o;
  const dd upper = dd(csl) * in.g + dd(snl) * in.h, lower = dd(csl) * in.h - dd(snl) * in.g, f = in.f;
  const std::array left = {f * csl * csr + upper * snr - ssmax, upper * csr - f * csl * snr,
                           lower * snr - f * snl * csr, lower * csr + f * snl * snr - ssmin};
  double most = std::abs((dd(ssmin) * ssmax / (f * in.h) - 1).hi);
  for (const dd& x : left) most = std::max(most, std::abs((x / ssmax).hi));
  return most;
}

void write(std::ostream& to, const inputs& in, const dlasv2_answer& o) {
  for (double x : {in.f, in.g, in.h, o[0], o[1], o[2], o[3], o[4], o[5]})
    to << (std::isnan(x) ? "nan" : hexfloat(x)) << ' ';
  to << '\n';
}

/// With SSMIN as SMIN and the others as SS.
call_outputs as_contct(const dlasv2_answer& o) {
  return {o[0], {o.begin() + 1, o.end()}, {}, {}};
}

/// The calls of one kind: how many values differ.
tally compare(const char* kind, inputs (*next)(random_numbers&), std::ostream& record) {
  random_numbers r(2026);
  tally t;
  for (int call = 1; call <= calls_of_a_kind; ++call) {
    const inputs in = next(r);
    const dlasv2_answer right = fortran(in), port = dlasv2(in.f, in.g, in.h);
    if (call <= recorded_of_a_kind) write(record, in, right);
    const bool first = t.mismatches == 0;
    const auto found = compare_answers(as_contct(right), as_contct(port), t);
    if (!found || !first) continue;
    std::clog << kind << " " << call << ": " << names[static_cast<std::size_t>(found->index)]
              << ": FORTRAN has " << found->leader << ", the port has " << found->follower << '\n';
  }
  std::cout << kind << ": " << t.mismatches << " of " << t.values << " values differ";
  return t;
}

/// Lockstep cannot see whether FORTRAN's answers are right, and whether they depend on shared arguments.
void certify() {
  random_numbers r(2026);
  double most = 0;
  int changed = 0;
  for (int call = 0; call < calls_of_a_kind; ++call) {
    const inputs in = random_call(r);
    most = std::max(most, residual(in, fortran(in)));
    changed += fortran(in) == fortran(in, true) ? 0 : 1;
  }
  std::cout << "\nlargest residual: " << most * 0x1p53 << " * 2^-53\nF and SSMIN in one variable: " << changed
            << " of " << calls_of_a_kind << " answers change\n";
}
}  // namespace

int main(int, char** arguments) {
  std::ofstream record(arguments[1]);
  const tally random = compare("random calls", random_call, record);
  std::cout << "; ";
  const tally aimed = compare("aimed calls", aimed_call, record);
  certify();
  const bool all = random.values == 6 * calls_of_a_kind && aimed.values == random.values;
  return all && random.mismatches + aimed.mismatches == 0 && record.flush() ? 0 : 1;
}
