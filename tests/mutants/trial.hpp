// Mutants put on trial, several at a time.
#pragma once

#include <string>
#include <vector>

#include "mutants/verdict.hpp"

namespace contct_test {

/// What came of one mutant.
struct trial {
  mutant which;
  verdict seen;
  std::string error;      ///< there is no verdict: it does not apply, does not compile
  std::string objection;  ///< it survived, or an equivalent one was killed

  [[nodiscard]] bool killed() const { return error.empty() && which.equivalent.empty() && !seen.lives(); }
};

/// What is wrong with `seen`; empty where it is as it has to be.
std::string objection(const mutant& m, const verdict& seen);

/// Build and judge all of them, `jobs` at a time, and say of each in a line what came of it. Before them the
/// files as they are go the same way, and have to live.
std::vector<trial> try_all(const std::vector<mutant>& mutants, const bounded_fuzz& fuzz, unsigned jobs);

/// The verdict in words: "killed by trace ties, call 3, SS(2)".
std::string in_words(const trial& t);

}  // namespace contct_test
