/* A plug-in with an ABI version that does not exist. */
#include <contct/kernel/plugin.h>

int contct_kernel_abi(void) {
  return CONTCT_KERNEL_ABI + 1;
}

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  (void)dd, (void)dtest, (void)cc, (void)ss, (void)smin, (void)id, (void)isep, (void)isurf;
  (void)nc, (void)indof, (void)ndofpn, (void)ndof;
}
