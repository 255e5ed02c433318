// [matrix] and [calculix]: a structure that another program assembled.
#pragma once

#include <string>

#include "contct/read/toml_reader.hpp"
#include "contct/structure/assembled.hpp"

namespace contct::read {

/// A file that a problem file names: relative to the folder of the latter.
[[nodiscard]] std::string beside(const std::string& folder, const std::string& name);

/// Read the table [matrix] with the files it names, or [calculix]. Throws input_error.
[[nodiscard]] assembled read_matrix(const table_reader& t, const std::string& folder);
[[nodiscard]] assembled read_calculix(const table_reader& t, const std::string& folder);

}  // namespace contct::read
