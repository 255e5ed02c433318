// What the golden set and the random calls say of a mutant.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mutants/definitions.hpp"

namespace contct_test {

/// One thing that a mutant did otherwise: the first in a trace, or among the random calls.
struct kill {
  std::string where;  ///< "trace ties" or "random 8"
  std::string what;   ///< "call 3, SS(2)", "crashes (signal 11)", "hangs"
};

struct verdict {
  std::vector<kill> kills;  ///< in the order of the judge: traces by name, then random calls

  [[nodiscard]] bool lives() const { return kills.empty(); }
  [[nodiscard]] std::optional<kill> first_in(const std::string& beginning) const;
  [[nodiscard]] int count_in(const std::string& beginning) const;
  [[nodiscard]] bool killed_by_golden_set() const { return count_in("trace") > 0; }
};

/// How many random calls a mutant gets in each precision, and their seed.
struct bounded_fuzz {
  long calls = 5000;
  long seed = 1989;
};

/// Build `m` from `source` and have it judged. Throws std::runtime_error when there is nothing to judge.
verdict judged(const mutant& m, const std::string& source, const bounded_fuzz& fuzz);

}  // namespace contct_test
