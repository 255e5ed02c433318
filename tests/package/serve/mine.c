/* A C program that runs a problem by libcontct.so: texts in, texts out. */
#include <contct/serve/serve.h>
#include <stdio.h>
#include <string.h>

static int checked = 0;
static int wrong = 0;

static void check(int holds, const char* what) {
  ++checked;
  if (holds) return;
  ++wrong;
  printf("wrong: %s\n", what);
}

int main(void) {
  const char* const problem =
      "[beam]\nlength = 2.0\nelements = 2\nEI = 1.0e4\n"
      "[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n"
      "[[step]]\npoint = [{ node = 3, w = -60.0 }]\n";
  char* answer = contct_run(problem, "{\"kernels\": [\"corrected\"]}");
  check(answer != NULL && strstr(answer, "\"exit\": 0,") != NULL, "a run");
  check(answer != NULL && strstr(answer, "\"certified\": true") != NULL, "its certificate");
  contct_free(answer);
  answer = contct_run("[beam]\nlength = -1\n", NULL);
  check(answer != NULL && strstr(answer, "\"exit\": 2,") != NULL, "bad input");
  check(answer != NULL && strstr(answer, "\"line\":2,\"column\":10") != NULL, "its place");
  contct_free(answer);
  check(contct_serve_version() == CONTCT_SERVE_VERSION, "the version of the interface");
  printf("%d facts, %d wrong\n", checked, wrong);
  return wrong > 0;
}
