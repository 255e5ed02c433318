/* A plug-in with faults; cc[0] of the call selects the fault. 0: no fault, and an answer without an event. */
#include <contct/kernel/plugin.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

int contct_kernel_abi(void) {
  return CONTCT_KERNEL_ABI;
}

/* Returns the address of the byte before array `which` (in the order of the arguments) or, if `behind`, of
 * the byte after this array. */
static char* edge(int which, int behind, const void* const arrays[], const size_t bytes[]) {
  char* const first = (char*)(size_t)arrays[which];
  return behind ? first + bytes[which] : first - 1;
}

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
  (void)indof, (void)ndofpn;
  const size_t pairs = (size_t)nc;
  const size_t dofs = (size_t)ndof;
  const void* const arrays[] = {dd, dtest, cc, ss, smin, id, isep, isurf};
  const size_t bytes[] = {dofs * sizeof *dd,    dofs * sizeof *dtest, pairs * sizeof *cc,
                          pairs * sizeof *ss,   sizeof *smin,         pairs * sizeof *id,
                          pairs * sizeof *isep, pairs * sizeof *isurf};
  const int fault = nc > 0 ? (int)cc[0] : 0;
  *smin = 1;
  for (int i = 0; i < nc; ++i) ss[i] = 1;
  switch (fault) {
    case 0:
      break;
    case 1:
      raise(SIGSEGV);
      break;
    case 3:
      exit(0);
    case 4:
      exit(3);
    case 5:
      for (;;) pause();
    case 6:
      printf("text of a plug-in\n");
      fflush(stdout);
      break;
    default:
      if (fault >= 10 && fault < 18) *edge(fault - 10, 0, arrays, bytes) ^= 1;
      if (fault >= 20 && fault < 28) *edge(fault - 20, 1, arrays, bytes) ^= 1;
      if (fault >= 30 && fault < 38) *(char*)(size_t)arrays[fault - 30] ^= 1;
  }
}
