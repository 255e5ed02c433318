// What every comparing command can say besides its table: JUnit, Markdown, or nothing at all.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/output_options.hpp"
#include "contct/text/report.hpp"

namespace contct {

struct report_options {
  bool quiet = false;
  std::string junit, markdown;
};

/// Add --quiet, --junit and --markdown to a command.
void add_report_options(CLI::App& command, report_options& options);

/// The outputs of these options behind `others`.
[[nodiscard]] std::vector<output_option> with_reports(std::vector<output_option> others,
                                                      const report_options& options);

/// The report's files, open before any work is done.
class report_files {
 public:
  explicit report_files(const report_options& options);
  void write(const check_report& report);

 private:
  std::unique_ptr<output_file> junit_, markdown_;
};

/// The floating-point probe's word, the listing's checksum and the program's version: facts that every
/// report carries.
[[nodiscard]] std::vector<std::string> common_facts();

}  // namespace contct
