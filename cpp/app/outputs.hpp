// Where a command writes: files of their own, and at most one of them standard output.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/report.hpp"

namespace contct::app {

/// An output as it was asked for; an empty path is one that was not.
struct output_option {
  const char* name;  ///< "--json"
  std::string path;
};

/// `others` and the outputs of `options`.
[[nodiscard]] std::vector<output_option> with_reports(std::vector<output_option> others,
                                                      const report_options& options);

/// Throws std::invalid_argument when two of these would be one file, when one is the file that
/// standard output goes to, when more than one is "-", or when one would replace one of `inputs`, whose
/// names say what they are: "the problem".
void refuse_shared_outputs(const std::vector<output_option>& outputs,
                           const std::vector<output_option>& inputs = {});

/// Is one of them "-"? Then nothing else is printed.
[[nodiscard]] bool takes_standard_output(const std::vector<output_option>& outputs);

/// The file of an option, open before any work is done; null where it was not asked for.
[[nodiscard]] std::unique_ptr<output_file> open_output(const output_option& o);

/// Write all of a file and give it its name. Does nothing where `file` is null.
void write_whole(const std::unique_ptr<output_file>& file, std::string_view text);

/// The files of --junit and --markdown, open before any work is done.
class report_files {
 public:
  explicit report_files(const report_options& options);
  void write(const check_report& report);

 private:
  std::unique_ptr<output_file> junit_, markdown_;
};

/// What every report says of the program: its version, the listing's checksum, the floating-point probe.
[[nodiscard]] std::vector<std::string> common_facts();

}  // namespace contct::app
