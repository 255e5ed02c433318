// An explained run, for people and as JSON: what the listing did in each call, every sentence with the line
// that did it.
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

class exact_addition;

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
