#include "contct/conform/compare.hpp"

namespace contct {
namespace {

/// Cut the first line off `text`, without its end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace

std::optional<divergence> compare_text(std::string_view leader, std::string_view follower, tally& t) {
  ++t.values;
  if (leader == follower) return std::nullopt;
  ++t.mismatches;
  int line = 0;
  std::string_view a;
  std::string_view b;
  do {
    ++line;
    a = take_line(leader);
    b = take_line(follower);
  } while (a == b && !(leader.empty() && follower.empty()));
  return divergence{"text", line, std::string(a), std::string(b), 0};
}

}  // namespace contct
