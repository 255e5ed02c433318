/* What reference LAPACK has in Fortran 90 or asks its compiler for, which f2c cannot translate: machine
 * constants, the 2-norm, a scaled sum of squares and a plane rotation. Only the eigenvalues of a matrix's
 * rigid motions (dsyev) and reflections come here. */
#include <float.h>
#include <math.h>

double dlamch_(const char* what, int length) {
  (void)length;
  switch (*what) {
    case 'E':
    case 'e':
      return DBL_EPSILON * 0.5;
    case 'S':
    case 's':
      return DBL_MIN;
    case 'B':
    case 'b':
      return 2.0;
    case 'P':
    case 'p':
      return DBL_EPSILON;
    case 'N':
    case 'n':
      return DBL_MANT_DIG;
    case 'R':
    case 'r':
      return 1.0;
    case 'M':
    case 'm':
      return DBL_MIN_EXP;
    case 'U':
    case 'u':
      return DBL_MIN;
    case 'L':
    case 'l':
      return DBL_MAX_EXP;
    case 'O':
    case 'o':
      return DBL_MAX;
    default:
      return 0.0;
  }
}

/* Adds the squares of x to *scale^2 * *sum, which neither overflow nor vanish; in LAPACK's order. */
void dlassq_(const int* n, const double* x, const int* incx, double* scale, double* sum) {
  double plain = 0.0, largest = *scale * (*sum > 0.0);
  for (int i = 0; i < *n; ++i) {
    const double a = fabs(x[i * *incx]);
    if (a > largest || a != a) largest = a;
  }
  const int is_plain = largest < 1e150 && largest > 1e-140;
  const double unit = is_plain || largest == 0.0 || !isfinite(largest) ? 1.0 : largest;
  for (int i = 0; i < *n; ++i) plain += (x[i * *incx] / unit) * (x[i * *incx] / unit);
  if (*sum > 0.0) plain += (*scale / unit) * (*scale / unit) * *sum;
  *scale = unit;
  *sum = plain;
}

double dnrm2_(const int* n, const double* x, const int* incx) {
  double scale = 1.0, sum = 0.0;
  dlassq_(n, x, incx, &scale, &sum);
  return scale * sqrt(sum);
}

/* c f + s g = r and c g - s f = 0. LAPACK squares numbers that are neither too small nor too large as they
 * are. */
void dlartg_(const double* f, const double* g, double* c, double* s, double* r) {
  const double f1 = fabs(*f), g1 = fabs(*g), least = sqrt(DBL_MIN), most = sqrt(1 / DBL_MIN / 2);
  if (g1 == 0.0) {
    *c = 1.0;
    *s = 0.0;
    *r = *f;
  } else if (f1 == 0.0) {
    *c = 0.0;
    *s = copysign(1.0, *g);
    *r = g1;
  } else {
    const int is_plain = f1 > least && f1 < most && g1 > least && g1 < most;
    const double unit = is_plain ? 1.0 : fmin(1 / DBL_MIN, fmax(DBL_MIN, fmax(f1, g1)));
    const double fs = *f / unit, gs = *g / unit, d = sqrt(fs * fs + gs * gs);
    *c = fabs(fs) / d;
    *r = copysign(d, *f);
    *s = gs / *r;
    *r *= unit;
  }
}

int disnan_(const double* x) {
  return *x != *x;
}

/* Blocks of reflections: dsyev asks for them from 128 rows on, and is asked for no more than a few. */
void dlarft_(const char* direct, const char* storev, const int* n, const int* k, double* v, const int* ldv,
             const double* tau, double* t, const int* ldt, int length_1, int length_2) {
  __builtin_trap();
}
void dlarfb_(const char* side, const char* trans, const char* direct, const char* storev, const int* m,
             const int* n, const int* k, const double* v, const int* ldv, const double* t, const int* ldt,
             double* c, const int* ldc, double* work, const int* ldwork, int length_1, int length_2,
             int length_3, int length_4) {
  __builtin_trap();
}

/* Of f2c's library, what the routines call. */
double d_sign(const double* a, const double* b) {
  return copysign(*a, *b);
}
int i_dnnt(const double* x) {
  return (int)lround(*x);
}
int i_nint(const float* x) {
  return (int)lroundf(*x);
}
int i_len(const char* text, int length) {
  return length;
}
/* Fortran's texts end in as many blanks as there is room for. */
void s_copy(char* to, const char* from, int room, int length) {
  for (int i = 0; i < room; ++i) to[i] = i < length ? from[i] : ' ';
}
int s_cmp(const char* a, const char* b, int length_a, int length_b) {
  for (int i = 0; i < length_a || i < length_b; ++i) {
    const unsigned char x = i < length_a ? (unsigned char)a[i] : ' ',
                        y = i < length_b ? (unsigned char)b[i] : ' ';
    if (x != y) return x - y;
  }
  return 0;
}

/* No routine of LAPACK is called with arguments that it refuses. */
void xerbla_(const char* name, const int* argument, int length) {
  (void)name, (void)argument, (void)length;
  __builtin_trap();
}
