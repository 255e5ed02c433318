// Supports, pairs and loads of a structure whose dofs have labels.
#pragma once

#include <string>

#include "contct/read/toml_reader.hpp"
#include "contct/structure/problem.hpp"

namespace contct::read {

/// Read [[support]], [[contact]] and [[step]] of `top` into `p`, whose geometry is a matrix. `folder` is
/// where load vectors are. Throws input_error.
void read_on_matrix(const table_reader& top, const std::string& folder, problem& p);

}  // namespace contct::read
