// Tributary lengths and areas from the decimals of a file.
#pragma once

#include <vector>

#include "contct/model/elements.hpp"

namespace contct {

/// [nodes] tributary_shares from the decimals of the coordinates, rounded once. tributary_shares subtracts
/// rounded coordinates, as the pairs' stiffness always did; far from x = 0 few of its digits are right.
[[nodiscard]] inline std::vector<double> exact_shares(const model& m) {
  std::vector<double> all;
  std::visit(
      [&all](const auto& kind) {
        for (const double_double& share : elements_of<double_double>(kind).shares()) all.push_back(share.hi);
      },
      m.kind);
  return all;
}

}  // namespace contct
