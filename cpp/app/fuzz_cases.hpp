// Found cases on disk: a trace, a Catch2 test case and a FORTRAN main program each.
#pragma once

#include <string>
#include <vector>

#include "contct/lab/case_files.hpp"

namespace contct {

/// Write all cases to `folder`, which is made where it is missing. Returns the names of the files.
std::vector<std::string> write_cases(const std::vector<found_case>& cases, const std::string& folder,
                                     std::uint64_t seed);

}  // namespace contct
