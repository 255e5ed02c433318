// The rows of a table of cases in a text file: changes of a correct problem file, and what is expected of it.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "contct/text/input_text.hpp"

namespace contct {

struct table_row {
  std::string fact;      ///< the last comment above the row
  std::string base;      ///< the name of the correct file
  std::string row;       ///< as in the table
  std::string text;      ///< the changed file
  std::string expected;  ///< the part of the row after "=>"
};

inline std::vector<std::string> split(const std::string& text, const std::string& mark) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, from)) {
    parts.push_back(text.substr(from, at - from));
    from = at + mark.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

/// Returns `text` with some lines replaced: "5 x = 0.5 && 7-11" replaces line 5 and removes lines 7 to 11.
/// "\n" is a line end.
inline std::string changed(const std::string& text, const std::string& changes) {
  std::vector<std::string> lines = split(text, "\n");
  for (const std::string& change : split(changes, " && ")) {
    if (change.empty()) continue;
    const std::size_t blank = std::min(change.find(' '), change.size());
    const auto numbers = split(change.substr(0, blank), "-");
    const std::string put = blank < change.size() ? change.substr(blank + 1) : "";
    const std::size_t first = std::stoul(numbers.front());
    for (std::size_t line = first; line <= std::stoul(numbers.back()); ++line) lines.at(line - 1) = "\n";
    lines[first - 1] = put.empty() ? "\n" : put;
    for (std::size_t at = 0; (at = lines[first - 1].find("\\n", at)) != std::string::npos;)
      lines[first - 1].replace(at, 2, "\n");
  }
  std::string all;
  for (const std::string& line : lines)
    if (line != "\n") all += line + "\n";
  return all.substr(0, all.size() - (lines.back().empty() ? 1 : 0));
}

/// Returns the rows of a table in tests/. "= NAME" names the correct file that the next rows change.
inline std::vector<table_row> rows_of(const std::string& table,
                                      const std::map<std::string, std::string>& bases) {
  std::vector<table_row> rows;
  std::string fact, base;
  for (const std::string& line : split(read_input(CONTCT_TESTS "/" + table), "\n")) {
    if (line.starts_with("# ")) {
      fact = line.substr(2);
    } else if (line.starts_with("= ")) {
      base = line.substr(2);
    } else if (const std::size_t mark = line.find("=> "); mark != std::string::npos) {
      const std::string changes = line.substr(0, mark == 0 ? 0 : mark - 1);
      rows.push_back({fact, base, line, changed(bases.at(base), changes), line.substr(mark + 3)});
    }
  }
  return rows;
}

/// Returns the message about a file that is refused, or "accepted".
inline std::string verdict(const std::function<void()>& reads) {
  try {
    reads();
  } catch (const input_error& e) {
    return e.what();
  }
  return "accepted";
}

/// Returns true if `text` begins with the first part of `pattern`, and has the others in this order. The
/// parts are separated by " .. ", and " .." may end the pattern.
inline bool has_in_order(const std::string& text, const std::string& pattern) {
  std::size_t from = 0;
  for (const std::string& part :
       split(pattern.substr(0, pattern.size() - (pattern.ends_with(" ..") ? 3 : 0)), " .. ")) {
    const std::size_t at = text.find(part, from);
    if (at == std::string::npos || (from == 0 && at != 0)) return false;
    from = at + std::max<std::size_t>(part.size(), 1);
  }
  return true;
}

}  // namespace contct
