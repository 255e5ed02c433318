/* Libraries that are refused as plug-ins. One macro is defined, which says what is wrong. */
#include <contct/kernel/plugin.h>
#include <signal.h>
#include <unistd.h>

int contct_kernel_abi(void) {
#ifdef other_abi
  return CONTCT_KERNEL_ABI + 1;
#else
  return CONTCT_KERNEL_ABI;
#endif
}

#ifndef no_symbol
void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  (void)dd, (void)dtest, (void)cc, (void)ss, (void)smin, (void)id, (void)isep, (void)isurf;
  (void)nc, (void)indof, (void)ndofpn, (void)ndof;
}
#endif

__attribute__((constructor)) static void when_loaded(void) {
#ifdef crashes_when_loaded
  raise(SIGSEGV);
#endif
#ifdef hangs_when_loaded
  for (;;) pause();
#endif
}
