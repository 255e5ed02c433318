// Checks the words of a text.
#pragma once

#include <string>
#include <vector>

#include "catch.hpp"

namespace contct {

/// Returns the number of places where `piece` begins in `text`.
inline std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

/// Checks that a text has all these words. "!" begins words that must be missing, "^" and "$" words with
/// which the text must begin and end; "^" allows any text, and "" the empty text alone.
inline void check_words(const std::string& text, const std::vector<std::string>& pieces) {
  for (const std::string& piece : pieces) {
    INFO("words: " << piece << "\ntext: " << text);
    const bool marked = !piece.empty() && std::string("!^$").find(piece[0]) != std::string::npos;
    const std::string words = piece.substr(marked ? 1 : 0);
    switch (marked ? piece[0] : ' ') {
      case '^':
        CHECK(text.starts_with(words));
        break;
      case '$':
        CHECK(text.ends_with(words));
        break;
      case '!':
        CHECK(text.find(words) == std::string::npos);
        break;
      default:
        CHECK((words.empty() ? text.empty() : text.find(words) != std::string::npos));
    }
  }
}

}  // namespace contct
