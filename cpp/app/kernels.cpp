// contct kernels: what is built in.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/outside/registry.hpp"

namespace contct::app {

exit_status run_command(const kernels_options& /*options*/) {
  fmt::print("{:<12} {:<8} {:<9} {:<11} {}\n", "kernel", "REAL", "rule", "language", "compiler");
  for (const std::string& name : kernel_names()) {
    const kernel_facts f = facts_of_kernel(name);
    fmt::print("{:<12} {} bytes  {:<9} {:<11} {}\n", f.name, f.real_bytes, f.rule, f.language, f.compiler);
  }
  fmt::print("\nfrom outside: plugin:LIBRARY (a shared library), pipe:COMMAND (calls as text)\n");
  fmt::print("listing sha256 {}\nfloating point: {}\n", CONTCT_LISTING_SHA256,
             describe(probe_floating_point()));
  return exit_status::solved;
}

}  // namespace contct::app
