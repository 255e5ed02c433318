// A whole input file as text.
#pragma once

#include <string>

namespace contct {

/// Read the file at `path`, or standard input for "-". Throws input_error when there is no such
/// file, when it is a directory, cannot be read, or is larger than 32 MiB.
[[nodiscard]] std::string read_input(const std::string& path);

}  // namespace contct
