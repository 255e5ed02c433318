// reference/errata.toml as data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contct_test {

/// `from` occurs exactly once in the listing; lines are parted by '\n'.
struct replacement {
  std::string from;
  std::string to;
};

/// One way to take an erratum back, and what must then be seen.
struct undo {
  std::string name;
  std::vector<replacement> replace;
  std::vector<std::string> compile;  ///< compiler options beside the usual ones
  std::string expect;                ///< a word of outcome.hpp
  std::string call;                  ///< the call of the battery where it is first seen
  std::string field;                 ///< SMIN, SS(i) or ISEP(i), for other-numbers
};

struct erratum {
  long number;
  std::string title;
  std::vector<std::string> ocr;       ///< what the OCR shows
  std::vector<std::string> compiled;  ///< what contct.f has there
  std::string kind;                   ///< `class`: syntax, semantics, standard or cosmetic
  std::string confidence;
  std::string evidence;
  std::vector<undo> undos;
};

/// Throws std::runtime_error, naming the erratum and the key, when one is missing or unknown.
std::vector<erratum> read_errata(const std::filesystem::path& file);

}  // namespace contct_test
