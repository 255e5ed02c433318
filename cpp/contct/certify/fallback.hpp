// The reference solution as the end of a step that a path cannot reach.
#pragma once

#include "contct/path/path.hpp"

namespace contct::certify {

/// A fallback for `s`, which must outlive it.
[[nodiscard]] fallback_solver fallback_to_reference(const linear_structure& s);

}  // namespace contct::certify
