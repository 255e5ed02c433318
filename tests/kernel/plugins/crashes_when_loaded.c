/* A library that crashes before anyone can ask it anything. */
#include <signal.h>

__attribute__((constructor)) static void crash(void) {
  raise(SIGSEGV);
}
