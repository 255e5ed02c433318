// tests/mutants/mutants.toml as data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contct_test {

/// One fault put into one kernel on purpose.
struct mutant {
  std::string id;     ///< begins with "f-" in FORTRAN, "c-" in C++
  std::string file;   ///< from the top of the tree; one of `mutable_files`
  std::string fault;  ///< one of `fault_classes`
  std::string find;   ///< occurs exactly once in the file, not in a comment
  std::string replace;
  std::string equivalent;  ///< why it must live: the proof in words; empty for one that must die
};

/// What may be mutated: the two kernels, and what the C++ one writes.
extern const std::vector<std::string> mutable_files;

/// Of what kind a fault is. "canary": so gross that a machinery in which it lives looks at nothing.
extern const std::vector<std::string> fault_classes;

[[nodiscard]] bool is_fortran(const mutant& m);

/// Throws std::runtime_error, naming the mutant and the key, when one is missing, unknown or not allowed.
std::vector<mutant> read_mutants(const std::filesystem::path& file);

}  // namespace contct_test
