// An exact path, for people and as JSON, format "contct-exact-1".
#pragma once

#include <string>

#include "contct/session/exact_run.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// Events with their shares and loads, the ends of the steps, and the kernels. Numbers are fractions up to
/// `digits` digits, decimals with so many beyond.
[[nodiscard]] std::string exact_text(const exact_run& r, int digits, const terminal& t);

/// Every number is a string "p/q" or "p". The file appears.
void write_exact_json(const exact_run& r, output_file& out);

}  // namespace contct
