/* Judges a kernel in C, or in any language with a C ABI:
 *   cc -O2 -ffp-contract=off -o judge judge.c mine.c -lm && ./judge ../contct-vectors-1.txt
 * mine.c has the function contct_kernel of cpp/contct/kernel/plugin.h, such as ../../kernels/contct_kernel.c.
 * Exit status 0: equal to the bit in every call; 1: not; 2: nothing was compared, or the file is cut short.
 */
#include <stdio.h>
#include <string.h>

void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin,
                   const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof);

static int same(double a, double b) {
  return (a != a && b != b) || memcmp(&a, &b, sizeof a) == 0;
}

int main(int argc, char** argv) {
  FILE* const file = argc == 2 ? fopen(argv[1], "r") : NULL;
  char name[100];
  int announced = 0, seen = 0, calls = 0, wrong = 0, number, real, indof, ndofpn, dofs, used, nc, dof;
  double expected_smin, found = 0, right = 0;
  if (!file || fscanf(file, "contct-vectors-1 %*s %d", &announced) != 1) return 2;
  while (fscanf(file, " call %99s %d %d %d %d %d %d %d %lf", name, &number, &real, &indof, &ndofpn, &dofs,
                &used, &nc, &expected_smin) == 9) {
    double dd[dofs + 1], dtest[dofs + 1], cc[nc + 1], ss[nc + 1], expected[nc + 1], smin = -7;
    int id[nc + 1], isep[nc + 1], isurf[nc + 1], after[nc + 1];
    char what[24] = ""; /* the first wrong value: SS(I), SMIN or ISEP(I) */
    memset(dd, 0xff, sizeof dd); /* NaN: the dofs of no pair */
    memset(dtest, 0xff, sizeof dtest);
    for (int i = 0; i < used; ++i)
      if (fscanf(file, "%d", &dof) != 1 || fscanf(file, "%lf %lf", &dd[dof - 1], &dtest[dof - 1]) != 2)
        return 2;
    for (int i = 0; i < nc; ++i)
      if (fscanf(file, "%d %d %d %lf %lf %d", &id[i], &isep[i], &isurf[i], &cc[i], &expected[i], &after[i]) !=
          6)
        return 2;
    ++seen;
    if (real != 8) continue;
    contct_kernel(dd, dtest, cc, ss, &smin, id, isep, isurf, nc, indof, ndofpn, dofs);
    for (int i = nc; i-- > 0;)
      if (isep[i] != after[i]) sprintf(what, "ISEP(%d)", i + 1), found = isep[i], right = after[i];
    if (!same(smin, expected_smin)) strcpy(what, "SMIN"), found = smin, right = expected_smin;
    for (int i = nc; i-- > 0;)
      if (!same(ss[i], expected[i])) sprintf(what, "SS(%d)", i + 1), found = ss[i], right = expected[i];
    if (*what && wrong++ == 0)
      printf("%s, call %d: found %s %.17g, expected %.17g\n", name, number, what, found, right);
    ++calls;
  }
  printf("%d calls, %d differ\n", calls, wrong);
  return calls == 0 || seen != announced ? 2 : wrong > 0;
}
