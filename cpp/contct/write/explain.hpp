// An explained run, for people and as JSON: what the listing did in each call, every sentence with the line
// that did it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contct/compare/explanation.hpp"
#include "contct/structure/problem.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/result_json.hpp"

namespace contct::write {

/// A sentence about a line of fortran/contct.f.
struct sentence {
  listing_line at;  ///< number 0: no line
  std::string words;
  std::string equation{};  ///< of the paper: "(4)", "lemma 2"; or empty
};

/// How pair `p` came to its s: the body of the DO 10 loop.
[[nodiscard]] std::vector<sentence> scale_factor_story(const explained_pair& p);

/// Which pair won, and by how much: from SMIN to the IF that returns.
[[nodiscard]] std::vector<sentence> winner_story(const explained_call& c);

/// Whether pair `p` was toggled, and why: the body of the DO 30 loop. `c` had an event.
[[nodiscard]] std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p);

/// "advancing", "receding", "stationary", "no response".
[[nodiscard]] std::string_view kind_of_contact(const explained_pair& p);

/// "winner", "same moment", "too early", "by its mark", "not toggled".
[[nodiscard]] std::string_view name_of(why_toggled why);

/// How far two numbers of kernels of `real_bytes` are apart in ULP.
[[nodiscard]] std::uint64_t ulps_apart(double first, double second, int real_bytes);

/// "fortran 0x1p-2, cpp equal to the bit", or by how many ULP they differ.
[[nodiscard]] std::string side_by_side_words(std::string_view first_name, double first,
                                             std::string_view second_name, double second, int real_bytes);

/// What an explanation is about.
struct explained_kernels {
  const problem& what;             ///< must outlive what is written of it
  std::vector<std::string> names;  ///< of one kernel or two
  int real_bytes;
  int pair;  ///< the only one wanted, from 1, or 0

  [[nodiscard]] bool wants(const explained_pair& p) const { return pair == 0 || pair == p.pair + 1; }
};

/// Prints increments, one at a time: the lines of the listing in the left margin, the paper's equations at
/// the right.
class explain_text {
 public:
  explain_text(explained_kernels of, const terminal& t);

  void print(const explained_increment& i);

 private:
  void print_load(const explained_increment& i) const;
  void print_pair(const explained_increment& i, const explained_pair& p) const;
  void print_winner(const explained_increment& i) const;
  void print_toggles(const explained_increment& i) const;
  void print_outcome(const explained_increment& i) const;
  void say(paint p, const std::string& words) const;
  void say(const sentence& t, bool loud = false) const;
  void say_side_by_side(std::string_view what, double first, double second) const;

  explained_kernels of_;
  load_path loads_;
  terminal terminal_;
  bool begun_ = false;
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
  load_path loads_;
  json_document document_;
};

}  // namespace contct::write
