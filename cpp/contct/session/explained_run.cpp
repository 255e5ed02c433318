#include "contct/session/explained_run.hpp"

#include <fmt/format.h>

#include <span>
#include <stdexcept>
#include <utility>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct {
void refuse_other_rules(const std::vector<std::string>& kernels) {
  for (const std::string& name : kernels) {
    if (facts_of_kernel(name).rule != contact_rule::listing)
      throw std::invalid_argument(
          fmt::format("--kernels: \"{}\" has another rule, which is not in the listing; allowed: kernels "
                      "with the 1989 rule. reference/corrected-rule.md describes the other; contct run "
                      "--free-run --kernels {},fortran compares the two",
                      name, name));
  }
  if (kernels[0].find(':') != std::string::npos)
    throw std::invalid_argument(
        fmt::format("--kernels: \"{}\" is an external kernel and cannot lead; allowed: a built-in kernel "
                    "first and this one second: --kernels fortran,{}",
                    kernels[0], kernels[0]));
  if (kernels.size() > 2)
    throw std::invalid_argument(
        fmt::format("--kernels: found {}; allowed: one or two, the first one leads", kernels.size()));
  if (kernels.size() == 2 && kernels[0] == kernels[1])
    throw std::invalid_argument("--kernels: \"" + kernels[0] + "\" is named twice");
}

explained_run::explained_run(const std::vector<std::string>& kernels, increments_wanted wanted,
                             explained_path::sink to)
    : leader(make_kernel(kernels[0])),
      told(leader->facts(), std::span(kernels).subspan(1), wanted, std::move(to)) {}

path_end explained_run::follow(const problem& p, const linear_structure& s, const std::string& engine,
                               observer* shown) {
  std::vector<observer*> watching = {&told, shown};
  std::erase(watching, nullptr);
  return contct::follow(p, s, engine_for(leader->facts(), engine, s), *leader, watching);
}

}  // namespace contct
