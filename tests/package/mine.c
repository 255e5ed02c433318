/* A C program with the 1989 code in it, in both precisions. */
#include <contct/kernel/contct.h>
#include <stdio.h>

/* Two free ends that rise towards faces above them: the first touches after a quarter of the load. */
static int answers_in_double_precision(void) {
  const double d[] = {0, 0}, d_star[] = {2, 1}; /* D; what the remaining load would add */
  const double faces[] = {0.5, 0.75};
  const int nodes[] = {1, 2}, above[] = {1, 1};
  int status[] = {1, 1}; /* separated */
  double s[2], smin;
  contct_call_r8(d, d_star, faces, s, &smin, nodes, status, above, 2, 1, 1);
  return smin == 0.25 && s[0] == 0.25 && s[1] == 0.75 && status[0] == -1 && status[1] == 1;
}

/* Three dofs a node, the second deflects; a pair of node 2 breaks. */
static int answers_as_printed(void) {
  const float d[] = {9, 9, 9, 9, 1, 9}, d_star[] = {9, 9, 9, 9, -8, 9};
  const float faces[] = {0.5F};
  const int nodes[] = {2}, below[] = {-1};
  int status[] = {-1};
  float s[1], smin;
  contct_call_r4(d, d_star, faces, s, &smin, nodes, status, below, 1, 2, 3);
  return smin == 0.0625F && s[0] == smin && status[0] == 1;
}

int main(void) {
  const int wrong = 2 - answers_in_double_precision() - answers_as_printed();
  printf("2 facts, %d wrong\n", wrong);
  return wrong;
}
