// An explained run as text and as JSON: the effect of each line of fortran/contct.f in each call.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contct/results/path_observers.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/result_json.hpp"

namespace contct {

/// The problem and the kernels that are explained.
struct explained_kernels {
  const problem& what;             ///< must outlive the outputs
  std::vector<std::string> names;  ///< one kernel or two
  int real_bytes;
  int pair;  ///< the pair to explain, from 1; 0: all pairs
  load_path loads{what};

  [[nodiscard]] bool wants(const explained_pair& p) const { return pair == 0 || pair == p.pair + 1; }
};

/// A sentence about a line of fortran/contct.f.
struct sentence {
  listing_line at;  ///< no_line if the sentence is about no line
  std::string words;
  std::string equation{};  ///< equation of the paper: "(4)", "lemma 2"; may be empty
};
inline constexpr listing_line no_line{0, {}};

/// "  38  s = GAP / d* = 0.25.                 (4)"; where there is room, with the statement behind its
/// number.
[[nodiscard]] std::string text_of(const terminal& screen, const sentence& t, bool loud = false);

/// "advancing", "receding", "stationary" or "no response".
[[nodiscard]] std::string_view kind_name(const explained_pair& p);

/// For example "Pair 1, node 3, face below, separated: advancing".
[[nodiscard]] std::string heading_of(const explained_pair& p, const std::string& place);
[[nodiscard]] std::string_view name_of(why_toggled why);

/// Explains how the listing computes the s of a pair: the body of its DO 10 loop.
[[nodiscard]] std::vector<sentence> scale_factor_story(const explained_pair& p);

/// Explains which pair has the smallest s, and which is next: the IF after the DO 10 loop.
[[nodiscard]] std::vector<sentence> winner_story(const explained_call& c);

/// Explains why the listing toggles the ISEP of a pair or not: its DO 30 loop. The call must have an event.
[[nodiscard]] std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p);

/// The difference between `first` and `second` in ULP of a REAL of `real_bytes`.
[[nodiscard]] std::uint64_t ulps_apart(double first, double second, int real_bytes);

/// Returns "fortran and cpp are equal to the bit", or their difference in ULP.
[[nodiscard]] std::string side_by_side_words(const explained_kernels& of, double first, double second);

inline constexpr std::size_t most_told_in_full = 20;

/// Formats increments one by one: line numbers of the listing on the left, equation numbers of the paper on
/// the right. In a summary, each increment is one line. Memory does not grow with the number of increments.
class explain_text {
 public:
  /// Without `all`, the text of a run of more than most_told_in_full increments is a summary.
  explain_text(explained_kernels of, const terminal& t, bool all = true);

  /// Adds an increment; returns the text that can be printed now.
  [[nodiscard]] std::string add(const explained_increment& i);

  /// Returns the rest of the text after the last increment.
  [[nodiscard]] std::string finish();

 private:
  explained_kernels of_;
  terminal terminal_;
  bool all_;
  std::size_t increments_ = 0;
  std::string in_full_;  // the increments in full, kept while a summary is still possible
  std::string summary_;  // lines of the summary that are not printed yet
};

/// Writes increments one by one as JSON, format "contct-explain-1" (reference/explain-format.md).
class explain_json {
 public:
  /// `out` must outlive this object.
  explain_json(explained_kernels of, output_file& out);

  void write(const explained_increment& i);

  /// Writes the end of the document, and finishes the file.
  void finish(std::string_view status, const explained_path& path);

 private:
  explained_kernels of_;
  json_document document_;
};

}  // namespace contct
