/* CONTCT in C as a plug-in. It is correct unless a macro compiles a fault in, for tests of contct fuzz. */
#include <math.h>
#include <stdlib.h>

#include "contct/kernel/plugin.h"

#ifndef WITHIN
#define WITHIN(diff) ((diff) < .390625E-02)
#endif
#ifndef SCALE
#define SCALE(gap, response) ((gap) / (response))
#endif

int contct_kernel_abi(void) {
  return CONTCT_KERNEL_ABI;
}

static double scale_factor(double gap, double response, int isep, int isurf) {
  if (response == 0.) return 1.;
  if (fabs(gap) < 1.E-10) {
    const double check = isep * isurf / response;
    return check > 0. ? check * 1.E-20 : 1.;
  }
  return SCALE(gap, response);
}

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  (void)ndof;
#ifdef CRASHES_AT
  static int calls = 0;
  if (++calls == CRASHES_AT) abort();
#endif
  *smin = 1.;
  for (int i = 0; i < nc; ++i) {
    const int dof = (id[i] - 1) * ndofpn + indof - 1;
    ss[i] = scale_factor(cc[i] - dd[dof], dtest[dof], isep[i], isurf[i]);
    if (ss[i] > 0. && ss[i] < *smin) *smin = ss[i];
  }
  if (*smin == 1.) return;
  for (int i = 0; i < nc; ++i) {
    if (WITHIN(fabs(ss[i] - *smin) / *smin)) isep[i] = isep[i] == 1 ? -1 : 1;
  }
}
