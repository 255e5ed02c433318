// Where a command writes: files of their own, and at most one of them standard output.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contct/text/output_file.hpp"

namespace contct {

/// An output as it was asked for; an empty path is one that was not.
struct output_option {
  const char* name;  ///< "--json"
  std::string path;
};

/// Throws std::invalid_argument when two of these would be one file, when one is the file that
/// standard output goes to, when more than one is "-", or when one would replace one of `inputs`, whose
/// names say what they are: "the problem".
void refuse_shared_outputs(const std::vector<output_option>& outputs,
                           const std::vector<output_option>& inputs = {});

/// Is one of them "-"? Then nothing else is printed.
[[nodiscard]] bool takes_standard_output(const std::vector<output_option>& outputs);

/// The file of an option, open before any work is done; none where it was not asked for.
[[nodiscard]] std::unique_ptr<output_file> open_output(const output_option& o);

}  // namespace contct
