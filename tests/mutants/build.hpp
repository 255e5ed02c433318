// From a mutated source to a program.
#pragma once

#include <filesystem>
#include <string>

#include "mutants/definitions.hpp"

namespace contct_test {

/// The source of `m`, mutated. Throws std::runtime_error where the text to replace does not occur exactly
/// once, or lies in a comment: such a mutation never existed.
std::string mutated_source(const mutant& m);

/// Compile `source` as the file of `m` and link it, in `folder`, with the judge in front of the libraries:
/// an object that defines what a library's member defines keeps that member out. Returns the program.
/// Throws std::runtime_error when it does not compile or link: a mutant that is none is no kill.
std::filesystem::path build_program(const mutant& m, const std::string& source,
                                    const std::filesystem::path& folder);

}  // namespace contct_test
