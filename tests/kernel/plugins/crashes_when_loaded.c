/* A library that crashes in its constructor, while it is loaded. */
#include <signal.h>

__attribute__((constructor)) static void crash(void) {
  raise(SIGSEGV);
}
