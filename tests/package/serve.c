/* A C program that runs a problem by libcontct.so: texts in, texts out. */
#include <contct/serve/serve.h>
#include <stdio.h>
#include <string.h>

/* Returns the number of `words` that are in the answer to a problem, and frees the answer. */
static int found(char* answer, const char* const words[2]) {
  const int count =
      answer == NULL ? 0 : (strstr(answer, words[0]) != NULL) + (strstr(answer, words[1]) != NULL);
  contct_free(answer);
  return count;
}

int main(void) {
  const char* const problem =
      "[beam]\nlength = 2.0\nelements = 2\nEI = 1.0e4\n"
      "[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n"
      "[[step]]\npoint = [{ node = 3, w = -60.0 }]\n";
  const char* const solved[] = {"\"exit\": 0,", "\"certified\": true"};
  const char* const refused[] = {"\"exit\": 2,", "\"line\":2,\"column\":10"};
  int right = found(contct_run(problem, "{\"kernels\": [\"corrected\"]}"), solved);
  right += found(contct_run("[beam]\nlength = -1\n", NULL), refused);
  right += contct_serve_version() == CONTCT_SERVE_VERSION;
  printf("5 facts, %d wrong\n", 5 - right);
  return 5 - right;
}
