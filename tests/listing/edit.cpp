#include "listing/edit.hpp"

#include <stdexcept>

namespace contct_test {
namespace {

/// Does the range touch a comment, a line with C in column 1?
bool touches_comment(std::string_view text, std::size_t begin, std::size_t end) {
  // A range that ends in a line end does not touch the line behind it; so for the one before it.
  while (begin < end && text[begin] == '\n') ++begin;
  std::size_t line = begin == 0 ? 0 : text.rfind('\n', begin - 1) + 1;
  while (line < end) {
    if (text[line] == 'C') return true;
    const std::size_t next = text.find('\n', line);
    if (next == std::string_view::npos) return false;
    line = next + 1;
  }
  return false;
}

}  // namespace

std::string edited(std::string listing, const std::vector<replacement>& replacements) {
  for (const replacement& r : replacements) {
    const std::size_t at = listing.find(r.from);
    if (at == std::string::npos) throw std::runtime_error("does not occur: " + r.from);
    if (listing.find(r.from, at + 1) != std::string::npos) {
      throw std::runtime_error("occurs more than once: " + r.from);
    }
    if (touches_comment(listing, at, at + r.from.size())) throw std::runtime_error("in a comment: " + r.from);
    listing.replace(at, r.from.size(), r.to);
  }
  return listing;
}

std::string in_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n';
    if (!blank) line += c;
    if (blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace contct_test
