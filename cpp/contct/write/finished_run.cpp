#include "contct/write/finished_run.hpp"

#include <algorithm>
#include <filesystem>

namespace contct {

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char ch) { return ch == '\n' || ch == '\r'; }, ' ');
  return text;
}

std::string title_of(const finished_run& r) {
  const bool named = r.what.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(r.what.title);
  return r.file == "-" ? "A problem from standard input" : std::filesystem::path(r.file).filename().string();
}

}  // namespace contct
