// What a page has in place of other processes and of libraries that are looked for at run time.
#include <stdexcept>

#include "contct/matrix/cholesky.hpp"
#include "contct/outside/child_kernel.hpp"

extern "C" void ilaver_(int* major, int* minor, int* patch);

namespace contct::matrix {

std::string lapack_identity() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  ilaver_(&major, &minor, &patch);
  return "LAPACK " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch) +
         ", by f2c";
}

}  // namespace contct::matrix

namespace contct::outside {

std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& /*limits*/) {
  throw std::invalid_argument("plugin:" + path + ": found a library; allowed in a page: built-in kernels");
}

std::unique_ptr<kernel> make_pipe(const std::string& command, const outside_limits& /*limits*/) {
  throw std::invalid_argument("pipe:" + command + ": found a command; allowed in a page: built-in kernels");
}

}  // namespace contct::outside
