// An explained run, for people and as JSON: what the listing did in each call, every sentence with the line
// of fortran/contct.f that did it; and what exact arithmetic says of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/exact/path_1989.hpp"
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

/// The listing's answer, without rounding, to the numbers that a call was given, as they are to the bit. None
/// where one of them is not finite.
[[nodiscard]] std::optional<listing_answer> answer_of(const explained_call& c);

/// A sentence that is added to an explanation; a loud one is in the colour of what is wrong.
struct added_remark {
  std::string words;
  bool loud = false;
};

/// The exact numbers beside each increment: those of the call's own input, and those of the exact path of the
/// 1989 rule. reference/explain-format.md has the members.
class exact_addition {
 public:
  using remarks = std::vector<added_remark>;

  /// `path` observes the same run, in front of what explains it, and must outlive this object; null where the
  /// exact path is not followed, for the reason in `why_no_path`.
  explicit exact_addition(const exact_companion* path, std::string why_no_path = {})
      : path_(path), why_no_path_(std::move(why_no_path)) {}

  /// Called before all others, once for each increment.
  void begin(const explained_increment& i) { call_ = answer_of(i.call); }
  /// Of one pair's s, of SMIN, and of the increment's end.
  [[nodiscard]] remarks of_s(const explained_kernels& of, const explained_increment& i,
                             const explained_pair& p) const;
  [[nodiscard]] remarks of_smin(const explained_kernels& of, const explained_increment& i) const;
  [[nodiscard]] remarks of_end(const explained_kernels& of, const explained_increment& i) const;
  /// Add members to those of an increment, and to those of a pair.
  void put_increment(nlohmann::ordered_json& out, const explained_kernels& of,
                     const explained_increment& i) const;
  void put_pair(nlohmann::ordered_json& out, const explained_kernels& of, const explained_increment& i,
                const explained_pair& p) const;

 private:
  /// The exact path's call; null where there is none that compares.
  [[nodiscard]] const exact_call* path_call() const { return path_ == nullptr ? nullptr : path_->call(); }
  [[nodiscard]] nlohmann::ordered_json path_json(const explained_kernels& of,
                                                 const explained_increment& i) const;

  const exact_companion* path_;
  std::string why_no_path_;
  std::optional<listing_answer> call_;  // of the increment at hand
};

/// How far two numbers of kernels of `real_bytes` are apart in ULP.
[[nodiscard]] std::uint64_t ulps_apart(double first, double second, int real_bytes);

/// "fortran and cpp are equal to the bit", or by how many ULP they differ; with the bits where `hex`:
/// "fortran 0x1p-2, cpp equal to the bit".
[[nodiscard]] std::string side_by_side_words(const explained_kernels& of, double first, double second,
                                             bool hex);

/// How much of a run explain_text has.
struct explain_detail {
  bool all =
      true;  ///< every increment; otherwise a line for each where there are more than most_told_in_full
  bool hex = false;  ///< the bits of s and SMIN
};
inline constexpr std::size_t most_told_in_full = 20;

/// Tells increments, one at a time: the lines of the listing in the left margin, the paper's equations at
/// the right. A summary is a line an increment; memory does not grow with their number.
class explain_text {
 public:
  explain_text(explained_kernels of, const terminal& t, explain_detail detail = {});

  /// What can be printed now. `more`: the exact numbers of the increment; null: none.
  [[nodiscard]] std::string add(const explained_increment& i, const exact_addition* more = nullptr);

  /// Behind the last increment: what was kept, or the end of the summary.
  [[nodiscard]] std::string finish();

 private:
  explained_kernels of_;
  terminal terminal_;
  explain_detail detail_;
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

  /// `more` as explain_text::add has it.
  void write(const explained_increment& i, const exact_addition* more = nullptr);

  /// Close the document.
  void finish(std::string_view status, const explained_path& path);

 private:
  explained_kernels of_;
  json_document document_;
};

}  // namespace contct
