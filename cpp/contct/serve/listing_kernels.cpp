#include "contct/serve/listing_kernels.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "contct/compare/compare.hpp"
#include "contct/kernel/registry.hpp"

namespace contct {

void refuse_other_rules(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (facts_of_kernel(name).rule != contact_rule::listing)
      throw std::invalid_argument(
          fmt::format("--kernels: \"{}\" has another rule, which is not in the listing; allowed: kernels "
                      "with the 1989 rule. reference/corrected-rule.md describes the other; contct run "
                      "--free-run --kernels {},fortran compares the two",
                      name, name));
  }
  if (names[0].find(':') != std::string::npos)
    throw std::invalid_argument(
        fmt::format("--kernels: \"{}\" is an external kernel and cannot lead; allowed: a built-in kernel "
                    "first and this one second: --kernels fortran,{}",
                    names[0], names[0]));
  if (names.size() > 2)
    throw std::invalid_argument(
        fmt::format("--kernels: found {}; allowed: one or two, the first one leads", names.size()));
  if (names.size() == 2 && names[0] == names[1])
    throw std::invalid_argument("--kernels: \"" + names[0] + "\" is named twice");
}

std::unique_ptr<kernel> second_kernel(const std::vector<std::string>& names) {
  if (names.size() < 2) return nullptr;
  refuse_unequal(facts_of_kernel(names[0]), facts_of_kernel(names[1]));
  return make_kernel(names[1]);
}

}  // namespace contct
