/* main() of a command for `--kernel pipe:./mine`, from a kernel with the C ABI of cpp/contct/kernel/plugin.h:
 *   cc -O2 -ffp-contract=off -o mine pipe_main.c mine.c -lm
 * Reads calls from standard input and writes answers to standard output (reference/trace-format.md).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof);

static void* numbers(size_t count, size_t size) {
  void* const made = malloc((count + 1) * size);
  if (!made) exit(1);
  return made;
}

int main(void) {
  int call, indof, ndofpn, dofs, nc, dof, i;
  char word[8];
  while (scanf(" call %d", &call) == 1) {
    while (getchar() != '\n') {
    }
    if (scanf("%7s", word) == 1 && strcmp(word, "note") == 0) { /* skip the note, which ends with its line */
      while (getchar() != '\n') {
      }
      if (scanf("%7s", word) != 1) return 1;
    }
    if (scanf(" %d ndofpn %d dofs %d nc %d", &indof, &ndofpn, &dofs, &nc) != 4) return 1;
    double *dd = numbers((size_t)dofs, sizeof *dd), *dtest = numbers((size_t)dofs, sizeof *dtest);
    double *cc = numbers((size_t)nc, sizeof *cc), *ss = numbers((size_t)nc, sizeof *ss), smin = -7;
    int *id = numbers((size_t)nc, sizeof *id), *isep = numbers((size_t)nc, sizeof *isep),
        *isurf = numbers((size_t)nc, sizeof *isurf);
    for (i = 0; i < nc; ++i) ss[i] = -7; /* contct takes -7 as a number that the kernel has not set */
    for (i = 0; i < dofs; ++i) dd[i] = dtest[i] = NAN;
    while (scanf(" dof %d dd", &dof) == 1)
      if (scanf(" %lf dtest %lf", &dd[dof - 1], &dtest[dof - 1]) != 2) return 1;
    for (i = 0; i < nc; ++i) /* the last scanf of " dof" has read no character of "pair" */
      if (scanf(" pair %*d id %d isep %d isurf %d cc %lf", &id[i], &isep[i], &isurf[i], &cc[i]) != 4)
        return 1;
    if (scanf("%7s", word) != 1) return 1; /* ask */
    contct_kernel(dd, dtest, cc, ss, &smin, id, isep, isurf, nc, indof, ndofpn, dofs);
    printf("smin %a\n", smin);
    for (i = 0; i < nc; ++i) printf("pair %d ss %a isep %d\n", i + 1, ss[i], isep[i]);
    printf("end\n");
    fflush(stdout);
    free(dd), free(dtest), free(cc), free(ss), free(id), free(isep), free(isurf);
  }
  return 0;
}
