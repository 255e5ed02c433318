/* CONTCT in C, as a plug-in: start yours from here.
 *
 *   cc -std=c11 -O2 -ffp-contract=off -shared -fPIC -I cpp -o kernel_c.so reference/kernels/contct_kernel.c
 *   build/release/contct fuzz --kernels fortran,plugin:kernel_c.so
 *
 * -ffp-contract=off: without it some machines round a product and a sum once where the listing rounds
 * twice. */
#include <contct/kernel/plugin.h>
#include <math.h>

/* The listing's DATA statement. */
static const double delta = 1e-20;        /* what an event at once is scaled by: almost no load */
static const double epsgap = 1e-10;       /* a gap below this length is none */
static const double epsmul = .390625e-02; /* pairs this close to the earliest go with it: 1/256 */

int contct_kernel_abi(void) {
  return CONTCT_KERNEL_ABI;
}

/* The share of the remaining load at which one pair has its event; 1 when it has none. Every comparison is
 * one that is false for NaN, as in FORTRAN: turn none of them round. */
static double scale_factor(double d, double d_star, double face, int isep, int isurf) {
  const double gap = face - d;
  if (d_star == 0) return 1; /* it does not move */
  if (fabs(gap) < epsgap) {  /* it touches: does it move away, or in? */
    const double s = isep * isurf / d_star;
    return s > 0 ? s * delta : 1;
  }
  return gap / d_star;
}

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  (void)ndof; /* the caller sees to it that every pair's dof is there */

  /* The scale factor of every pair, and the earliest that is still to come. */
  *smin = 1;
  for (int i = 0; i < nc; ++i) {
    const int dof = (id[i] - 1) * ndofpn + indof - 1; /* nodes and dofs are numbered from 1 */
    ss[i] = scale_factor(dd[dof], dtest[dof], cc[i], isep[i], isurf[i]);
    if (ss[i] > 0 && ss[i] < *smin) *smin = ss[i];
  }
  if (*smin == 1) return; /* no event: all of the load can be applied */

  /* Toggle the earliest, and whatever comes within EPSMUL of it. */
  for (int i = 0; i < nc; ++i) {
    if (fabs(ss[i] - *smin) / *smin < epsmul) isep[i] = isep[i] == 1 ? -1 : 1;
  }
}
