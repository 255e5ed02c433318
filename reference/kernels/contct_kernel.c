/* CONTCT in C as a plug-in, from which you can start your own kernel.
 *
 *   cc -std=c11 -O2 -ffp-contract=off -shared -fPIC -I cpp -o kernel_c.so reference/kernels/contct_kernel.c
 *   build/release/contct fuzz --kernels fortran,plugin:kernel_c.so
 *
 * -ffp-contract=off keeps the two roundings of a product and a sum; a fused operation rounds once. */
#include <contct/kernel/plugin.h>
#include <math.h>

/* The listing's DATA statement. */
static const double delta = 1e-20;        /* factor of s for an event at no additional load */
static const double epsgap = 1e-10;       /* a pair with a smaller gap is at its face */
static const double epsmul = .390625e-02; /* relative distance of toggled pairs from SMIN: 1/256 */

int contct_kernel_abi(void) {
  return CONTCT_KERNEL_ABI;
}

/* Returns s of one pair. If s is between 0 and 1, the pair has its event at this share of the remaining load.
 * Do not negate a comparison: all comparisons with NaN are false, as in FORTRAN. */
static double scale_factor(double d, double d_star, double face, int isep, int isurf) {
  const double gap = face - d;
  if (d_star == 0) return 1; /* the pair does not move */
  if (fabs(gap) < epsgap) {  /* at the face: an event if the motion changes the status */
    const double s = isep * isurf / d_star;
    return s > 0 ? s * delta : 1;
  }
  return gap / d_star;
}

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  (void)ndof; /* the caller has checked that every pair's dof exists */

  /* SS of every pair, and SMIN, the smallest positive SS below 1. */
  *smin = 1;
  for (int i = 0; i < nc; ++i) {
    const int dof = (id[i] - 1) * ndofpn + indof - 1; /* nodes and dofs are numbered from 1 */
    ss[i] = scale_factor(dd[dof], dtest[dof], cc[i], isep[i], isurf[i]);
    if (ss[i] > 0 && ss[i] < *smin) *smin = ss[i];
  }
  if (*smin == 1) return; /* no event: the whole load can be applied */

  /* Toggle all pairs whose SS is within EPSMUL of SMIN. */
  for (int i = 0; i < nc; ++i) {
    if (fabs(ss[i] - *smin) / *smin < epsmul) isep[i] = isep[i] == 1 ? -1 : 1;
  }
}
