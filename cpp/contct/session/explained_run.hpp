// A run that is explained as it goes on, line by line of the listing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/model/problem.hpp"
#include "contct/model/structure.hpp"
#include "contct/path/path.hpp"
#include "contct/path/path_observers.hpp"

namespace contct {

/// Throws std::invalid_argument unless these are one or two kernels of the 1989 rule, whose lines the listing
/// has, the first one built in.
void refuse_other_rules(const std::vector<std::string>& kernels);

struct explained_run {
  /// `kernels` as refuse_other_rules has them; `to` is given the increments that are wanted. Throws
  /// std::invalid_argument where the second cannot be compared with the first, and as make_kernel does.
  explained_run(const std::vector<std::string>& kernels, increments_wanted wanted, explained_path::sink to);

  /// Follow the leader's path; `engine` may be empty or "auto". `shown` watches it too, and may be null.
  path_end follow(const problem& p, const linear_structure& s, const std::string& engine,
                  observer* shown = nullptr);

  [[nodiscard]] bool equal() const { return told.compared().mismatches == 0; }

  std::unique_ptr<kernel> leader;
  explained_path told;
};

}  // namespace contct
