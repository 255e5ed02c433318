// A problem's structure, and its path.
#pragma once

#include <string_view>
#include <vector>

#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// The structure that a problem describes.
[[nodiscard]] linear_structure structure_of(const problem& p);

/// The load vectors of a problem's steps. `p` must outlive them.
[[nodiscard]] load_history loads_of(const problem& p);

/// Follow a problem's path on an engine by name. `s` is its structure.
path_end follow(const problem& p, const linear_structure& s, std::string_view engine, kernel& leader,
                const std::vector<observer*>& observers, const path_limits& limits = {});

}  // namespace contct
