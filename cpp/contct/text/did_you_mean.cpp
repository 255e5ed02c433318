#include "contct/text/did_you_mean.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace contct::text {
namespace {

constexpr std::size_t longest_word = 64;  // the table grows with its square

char lower(char ch) {
  return ch >= 'A' && ch <= 'Z' ? static_cast<char>(ch - 'A' + 'a') : ch;
}

}  // namespace

int edits_between(std::string_view a, std::string_view b) {
  // edits[i][j]: from the first i characters of a to the first j of b.
  std::vector<std::vector<int>> edits(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      const int replaced = edits[i - 1][j - 1] + (same ? 0 : 1);
      edits[i][j] = std::min({replaced, edits[i - 1][j] + 1, edits[i][j - 1] + 1});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

std::string_view nearest(std::string_view found, std::span<const std::string> known) {
  if (found.size() > longest_word) return {};
  std::string_view best;
  int least = 0;
  for (const std::string& k : known) {
    const int edits = edits_between(found, k);
    const int allowed = std::max(1, static_cast<int>(k.size()) / 3);
    if (edits > allowed || edits >= static_cast<int>(k.size())) continue;
    if (best.empty() || edits < least) {
      best = k;
      least = edits;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view found, std::span<const std::string> known) {
  const std::string_view meant = nearest(found, known);
  return meant.empty() ? "" : " (did you mean \"" + std::string(meant) + "\"?)";
}

}  // namespace contct::text
