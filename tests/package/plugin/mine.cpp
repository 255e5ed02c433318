// Loads the plug-in as a host does, by its two names, and puts a call to it.
#include <contct/kernel/plugin.h>
#include <dlfcn.h>

#include <cstdio>

int main() {
  void* const library = dlopen(KERNEL_OF_MINE, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::printf("wrong: %s\n", dlerror());
    return 1;
  }
  const auto abi = reinterpret_cast<decltype(&contct_kernel_abi)>(dlsym(library, "contct_kernel_abi"));
  const auto kernel = reinterpret_cast<decltype(&contct_kernel)>(dlsym(library, "contct_kernel"));
  if (abi == nullptr || kernel == nullptr || abi() != CONTCT_KERNEL_ABI) {
    std::printf("wrong: the plug-in does not have its two functions, or another ABI\n");
    return 1;
  }
  const double dd[] = {9, 9, 9, 9, 1, 9};
  const double dtest[] = {9, 9, 9, 9, -8, 9};
  const double cc[] = {0.5};
  const int id[] = {2};
  const int isurf[] = {-1};
  int isep[] = {-1};
  double ss[1] = {0};
  double smin = 0;
  kernel(dd, dtest, cc, ss, &smin, id, isep, isurf, 1, 2, 3, 6);
  const bool right = smin == 0.0625 && ss[0] == 0.0625 && isep[0] == 1;
  std::printf("%d facts, %d wrong\n", 4, right ? 0 : 1);
  return right ? 0 : 1;
}
