// reference/mutants.md: the kill matrix.
#pragma once

#include <string>
#include <vector>

#include "mutants/trial.hpp"

namespace contct_test {

/// The beginning of a mutant's row: its id, the class of fault, what was changed.
std::string row_beginning(const mutant& m);

/// The whole row of an equivalent mutant.
std::string equivalent_row(const mutant& m);

/// The whole page. `trials` are without error and objection.
std::string page(const std::vector<trial>& trials, const bounded_fuzz& fuzz);

}  // namespace contct_test
