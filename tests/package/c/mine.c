/* A C program with the 1989 code in it, in both precisions. */
#include <contct/kernel/contct.h>
#include <stdio.h>

static int checked = 0;
static int wrong = 0;

static void check(int holds, const char* what) {
  ++checked;
  if (holds) return;
  ++wrong;
  printf("wrong: %s\n", what);
}

/* Two free ends that rise towards faces above them: the first touches after a quarter of the load. */
static void call_it_in_double_precision(void) {
  const double d[] = {0, 0}, d_star[] = {2, 1}; /* D; what the remaining load would add */
  const double faces[] = {0.5, 0.75};
  const int nodes[] = {1, 2}, above[] = {1, 1};
  int status[] = {1, 1}; /* separated */
  double s[2], smin;
  contct_call_r8(d, d_star, faces, s, &smin, nodes, status, above, 2, 1, 1);
  check(smin == 0.25 && s[0] == 0.25 && s[1] == 0.75, "SMIN and SS");
  check(status[0] == -1 && status[1] == 1, "ISEP");
}

/* Three dofs a node, the second deflects; a pair of node 2 breaks. */
static void call_it_as_printed(void) {
  const float d[] = {9, 9, 9, 9, 1, 9}, d_star[] = {9, 9, 9, 9, -8, 9};
  const float faces[] = {0.5F};
  const int nodes[] = {2}, below[] = {-1};
  int status[] = {-1};
  float s[1], smin;
  contct_call_r4(d, d_star, faces, s, &smin, nodes, status, below, 1, 2, 3);
  check(smin == 0.0625F && s[0] == smin && status[0] == 1, "an answer in single precision");
}

int main(void) {
  call_it_in_double_precision();
  call_it_as_printed();
  printf("%d facts, %d wrong\n", checked, wrong);
  return wrong == 0 ? 0 : 1;
}
