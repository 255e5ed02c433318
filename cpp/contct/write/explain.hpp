// An explained run, for people and as JSON: what the listing did in each call, every sentence with the line
// of fortran/contct.f that did it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/path/path_observers.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/result_json.hpp"

namespace contct {

/// What an explanation is about.
struct explained_kernels {
  const problem& what;             ///< must outlive what is written of it
  std::vector<std::string> names;  ///< of one kernel or two
  int real_bytes;
  int pair;  ///< the only one wanted, from 1, or 0
  load_path loads{what};

  [[nodiscard]] bool wants(const explained_pair& p) const { return pair == 0 || pair == p.pair + 1; }
};

/// A sentence about a line of fortran/contct.f.
struct sentence {
  listing_line at;  ///< number 0: no line
  std::string words;
  std::string equation{};  ///< of the paper: "(4)", "lemma 2"; or empty
};
inline constexpr listing_line no_line{0, {}};

/// "advancing", "receding", "stationary" or "no response".
[[nodiscard]] std::string_view kind_name(listing_branch way, bool is_separated);
[[nodiscard]] inline std::string_view kind_name(const explained_pair& p) {
  return kind_name(p.way, p.isep_before == separated);
}
/// "winner", "too early", ..
[[nodiscard]] std::string_view name_of(why_toggled why);

/// How a pair came to its s: the body of the DO 10 loop.
[[nodiscard]] std::vector<sentence> scale_factor_story(const explained_pair& p);

/// Which pair won, and by how much: from SMIN to the IF that returns.
[[nodiscard]] std::vector<sentence> winner_story(const explained_call& c);

/// Whether a pair was toggled, and why: the body of the DO 30 loop. The call had an event.
[[nodiscard]] std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p);

/// How far two numbers of kernels of `real_bytes` are apart in ULP.
[[nodiscard]] std::uint64_t ulps_apart(double first, double second, int real_bytes);

/// "fortran and cpp are equal to the bit", or by how many ULP they differ.
[[nodiscard]] std::string side_by_side_words(const explained_kernels& of, double first, double second);

inline constexpr std::size_t most_told_in_full = 20;

/// Tells increments, one at a time: the lines of the listing in the left margin, the paper's equations at
/// the right. A summary is a line an increment; memory does not grow with their number.
class explain_text {
 public:
  /// Without `all`, a run of more than most_told_in_full increments has a line for each.
  explain_text(explained_kernels of, const terminal& t, bool all = true);

  /// What can be printed now.
  [[nodiscard]] std::string add(const explained_increment& i);

  /// Behind the last increment: what was kept, or the end of the summary.
  [[nodiscard]] std::string finish();

 private:
  explained_kernels of_;
  terminal terminal_;
  bool all_;
  std::size_t increments_ = 0;
  std::string in_full_;  // kept until it is known how many increments there are
  std::string summary_;  // its lines that are not printed yet
};

/// Writes increments as they come, format "contct-explain-1" (reference/explain-format.md): memory does not
/// grow with them. The file appears with `finish`.
class explain_json {
 public:
  /// `out` must outlive this object.
  explain_json(explained_kernels of, output_file& out);

  void write(const explained_increment& i);

  /// Close the document.
  void finish(std::string_view status, const explained_path& path);

 private:
  explained_kernels of_;
  json_document document_;
};

}  // namespace contct
