// A whole input file as text, and the refusal of what is wrong in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "contct/rooms.hpp"

namespace contct::text {

/// What is wrong with a file, where, what was found, what is allowed. what() is the whole message:
/// "pb.toml:12:3: contact[2].stiffness: found -5; allowed: a number greater than 0".
class input_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throw the input_error "file:line: found ...; allowed: ...". Lines count from 1; 0 names the file alone.
[[noreturn]] void refuse_line(std::string_view file, std::int64_t line, std::string_view found,
                              std::string_view allowed);

/// Read the file at `path`, or standard input for "-". `kind` says for messages what it should be: "problem
/// file". Throws input_error when there is no such file, when it is a directory, cannot be read, or is as
/// large as `most_mib`: a beam of 100,000 nodes with every coordinate written out takes 2.
[[nodiscard]] std::string read_input(const std::string& path, const std::string& kind = "problem file",
                                     std::size_t most_mib = 32);

}  // namespace contct::text
