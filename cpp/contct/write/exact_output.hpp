// An exact path, for people and as JSON, format "contct-exact-1".
#pragma once

#include <string>
#include <vector>

#include "contct/exact/kernel_digits.hpp"
#include "contct/exact/path.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// All that is written of an exact path. All must outlive it.
struct exact_result {
  const problem& what;
  const exact_problem& exactly;
  const exact_path& path;
  const std::vector<kernel_digits>& kernels;
};

/// Events with their shares and loads, the ends of the steps, and the kernels. Numbers are fractions up to
/// `digits` digits, decimals with so many beyond.
[[nodiscard]] std::string exact_text(const exact_result& r, int digits, const terminal& t);

/// Every number is a string "p/q" or "p". The file appears.
void write_exact_json(const exact_result& r, output_file& out);

}  // namespace contct
