#include "contct/compare/compare.hpp"

#include <algorithm>

namespace contct::compare {
namespace {

/// Cut the first line off `text`, without its end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

/// Cut the first word off `line`, with a number's zero before the point left out: -0.25 becomes -.25.
std::string take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  std::string word(line.substr(0, line.find(' ')));
  line.remove_prefix(word.size());
  const std::size_t digit = word.find_first_not_of('-');
  if (digit != std::string::npos && word.compare(digit, 2, "0.") == 0) word.erase(digit, 1);
  return word;
}

/// Do two lines have the same words?
bool mean_the_same(std::string_view a, std::string_view b) {
  while (!a.empty() || !b.empty()) {
    if (take_word(a) != take_word(b)) return false;
  }
  return true;
}

bool equal(std::string_view a, std::string_view b, text_equality equality) {
  return equality == text_equality::bytes ? a == b : mean_the_same(a, b);
}

}  // namespace

text_equality text_equality_of(const kernel_facts& leader, const kernel_facts& follower) {
  return leader.text_by_meaning || follower.text_by_meaning ? text_equality::meaning : text_equality::bytes;
}

std::optional<mismatch> compare_text(std::string_view leader, std::string_view follower, tally& t,
                                     text_equality equality) {
  ++t.values;
  for (int line = 1; leader != follower; ++line) {
    // A line that is missing, or that lacks its end, is another line.
    const bool both_end =
        leader.find('\n') != std::string_view::npos && follower.find('\n') != std::string_view::npos;
    const std::string_view a = take_line(leader);
    const std::string_view b = take_line(follower);
    if (both_end && equal(a, b, equality)) continue;
    ++t.mismatches;
    return mismatch{"text", line, std::string(a), std::string(b), 0};
  }
  return std::nullopt;
}

}  // namespace contct::compare
