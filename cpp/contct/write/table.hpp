// The run as a table on the terminal, an increment a row.
#pragma once

#include <string>
#include <vector>

#include "contct/session/run_result.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// A share in at most nine columns, with as many digits as fit. What is less than 1 is never shown as 1,
/// which means the whole load: "1-3e-09".
[[nodiscard]] std::string share_words(double x);

/// The run as the terminal shows it.
struct run_table {
  std::string text;                 ///< lines
  std::vector<std::string> legend;  ///< what its columns and words mean, to stand below it
};
/// `detail`: every event, and all numbers of each step's end.
[[nodiscard]] run_table table_of(const run_result& r, const terminal& t, bool detail);

}  // namespace contct
