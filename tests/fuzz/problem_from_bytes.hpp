// A small problem made from a fuzzer's bytes: mostly one that is solved, now and then one with extreme
// numbers, and with texts of any characters.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <map>
#include <string>

namespace contct::fuzz {

/// A problem file as text, and the files that it names, by their names.
struct made_problem {
  std::string text;
  std::map<std::string, std::string> files;
};

/// At most 9 elements of a beam, 9 of a plate, or 8 dofs of a matrix, with a few supports, pairs and steps.
[[nodiscard]] made_problem problem_from(FuzzedDataProvider& bytes);

/// Some bytes as a person may have them in a name; 24 at most.
[[nodiscard]] std::string words_from(FuzzedDataProvider& bytes);

}  // namespace contct::fuzz
