// The oracle as the one who ends a step that a mended path could not.
#pragma once

#include "contct/path/path.hpp"

namespace contct {

/// A rescuer for `s`, which must outlive it.
[[nodiscard]] fallback_solver fallback_to_reference(const linear_structure& s);

}  // namespace contct
