/* An empty kernel in C: a plug-in that answers every call and computes nothing yet. */
#include <contct/kernel/plugin.h>

int contct_kernel_abi(void) {
  return CONTCT_KERNEL_ABI;
}

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  (void)dd, (void)dtest, (void)cc, (void)id, (void)isep, (void)isurf, (void)indof, (void)ndofpn, (void)ndof;
  *smin = 0;
  for (int i = 0; i < nc; ++i) ss[i] = 0;
}
