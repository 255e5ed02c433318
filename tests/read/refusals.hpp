// Files that must be refused, with the required parts of the messages.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/text/input_text.hpp"

namespace contct {

/// Returns the message about a file, or "accepted".
inline std::string verdict(const std::function<void()>& reads) {
  try {
    reads();
  } catch (const input_error& e) {
    return e.what();
  }
  return "accepted";
}

struct bad_input {
  const char* what;     ///< the mistake
  std::string text;     ///< problem file
  const char* place;    ///< "line:column" of the mistake
  const char* key;      ///< key that the message must name
  const char* found;    ///< required words after "found"
  const char* allowed;  ///< required words after "allowed"
};

/// A file of any other format with a mistake.
struct bad_file {
  std::string text;
  const char* place;  ///< file's name and place
  const char* found;
  const char* allowed;
};

inline void check_refusals(const std::vector<bad_file>& files,
                           std::string (*verdict_of)(const std::string&)) {
  for (const bad_file& f : files) {
    const std::string message = verdict_of(f.text);
    INFO(f.text << "\n" << message);
    CHECK_THAT(message, Catch::Matchers::StartsWith(f.place));
    CHECK_THAT(message, Catch::Matchers::Contains(std::string("found ") + f.found));
    CHECK_THAT(message, Catch::Matchers::Contains(f.allowed));
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.size() < 300);
  }
}

}  // namespace contct
