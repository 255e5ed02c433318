// What a comparing command found, for machines: JUnit for CI systems, Markdown for their summaries.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::text {

enum class outcome { passed, failed, skipped };

/// One thing that was checked.
struct check_result {
  std::string name;  ///< "pb07.trace: cpp"
  outcome what = outcome::passed;
  std::string summary;  ///< one line: "8 calls, 64 values, 0 mismatches"
  std::string details;  ///< of a failure, lines
};

/// What one command checked.
struct check_report {
  std::string command;             ///< "contct replay"
  std::vector<std::string> facts;  ///< "floating point: strict", ...
  std::vector<check_result> results;
  double seconds = 0.0;

  [[nodiscard]] std::int64_t count(outcome o) const;
};

/// The report as JUnit XML: a test suite with a test case for each result.
[[nodiscard]] std::string junit_xml(const check_report& r);

/// The report as a Markdown summary: the verdict, a table, the details of what failed.
[[nodiscard]] std::string markdown(const check_report& r);

}  // namespace contct::text
