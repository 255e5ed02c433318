// A copy of the listing, compiled and put to the battery.
#pragma once

#include <string>
#include <vector>

#include "listing/outcome.hpp"

namespace contct_test {

/// `source` compiled, with `options` beside the usual ones, and run on the battery in a child.
behaviour try_out(const std::string& source, const std::vector<std::string>& options);

/// Does the check of reference/contct.f.sha256 (checksum.cmake) refuse this source?
bool checksum_refuses(const std::string& source);

}  // namespace contct_test
