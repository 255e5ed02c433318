// What is wrong with a command line, in words that help.
#pragma once

#include <string>
#include <vector>

#include "app/options.hpp"

namespace contct::app {

/// `error` as the parser words it, and what may have been meant by an option or a command that `program` does
/// not have. `command` is empty when the command line names none. `unknown`: the arguments that were not
/// understood.
[[nodiscard]] std::string usage_words(const program_description& program, const std::string& command,
                                      const std::vector<std::string>& unknown, const std::string& error);

}  // namespace contct::app
