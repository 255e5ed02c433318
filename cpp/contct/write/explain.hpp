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

namespace contct::write {

/// How far two numbers of kernels of `real_bytes` are apart in ULP.
[[nodiscard]] std::uint64_t ulps_apart(double first, double second, int real_bytes);

/// "fortran and cpp are equal to the bit", or by how many ULP they differ; with the bits where `hex`:
/// "fortran 0x1p-2, cpp equal to the bit".
[[nodiscard]] std::string side_by_side_words(std::string_view first_name, double first,
                                             std::string_view second_name, double second, int real_bytes,
                                             bool hex);

/// What an explanation is about.
struct explained_kernels {
  const problem& what;             ///< must outlive what is written of it
  std::vector<std::string> names;  ///< of one kernel or two
  int real_bytes;
  int pair;  ///< the only one wanted, from 1, or 0
  load_path loads{what};

  [[nodiscard]] bool wants(const explained_pair& p) const { return pair == 0 || pair == p.pair + 1; }
};

/// "advancing", "receding", "stationary" or "no response".
[[nodiscard]] std::string_view kind_name(way_to_s way, bool is_separated);

/// A sentence that is added to an explanation; a loud one is in the colour of what is wrong.
struct added_remark {
  std::string words;
  bool loud = false;
};

/// What else is told of each increment. The exact numbers are one: explain_exact.hpp, which what is installed
/// does not need.
class explain_addition {
 public:
  using remarks = std::vector<added_remark>;

  explain_addition() = default;
  explain_addition(const explain_addition&) = delete;
  explain_addition& operator=(const explain_addition&) = delete;
  virtual ~explain_addition() = default;

  /// Called before all others, once for each increment.
  virtual void begin(const explained_increment& i) = 0;
  /// Of one pair's s, of SMIN, and of the increment's end.
  [[nodiscard]] virtual remarks of_s(const explained_kernels& of, const explained_increment& i,
                                     const explained_pair& p) const = 0;
  [[nodiscard]] virtual remarks of_smin(const explained_kernels& of, const explained_increment& i) const = 0;
  [[nodiscard]] virtual remarks of_end(const explained_kernels& of, const explained_increment& i) const = 0;
  /// Add members to those of an increment, and to those of a pair.
  virtual void put_increment(nlohmann::ordered_json& out, const explained_kernels& of,
                             const explained_increment& i) const = 0;
  virtual void put_pair(nlohmann::ordered_json& out, const explained_kernels& of,
                        const explained_increment& i, const explained_pair& p) const = 0;
};

/// How much of a run explain_text prints.
struct explain_detail {
  bool all =
      true;  ///< every increment; otherwise a line for each where there are more than most_told_in_full
  bool hex = false;  ///< the bits of s and SMIN
};
inline constexpr std::size_t most_told_in_full = 20;

/// A summary of many increments: what stands above its lines (`title`, the problem's, may be empty), the line
/// of an increment with its share of the step, its events and which were too early, and what stands below.
[[nodiscard]] std::string summary_head(const terminal& t, const std::string& title);
[[nodiscard]] std::string summary_line(const terminal& t, const explained_increment& i);
[[nodiscard]] std::string summary_end(const terminal& t, std::size_t increments);

/// Prints increments, one at a time: the lines of the listing in the left margin, the paper's equations at
/// the right. A summary is a line an increment; memory does not grow with their number.
class explain_text {
 public:
  explain_text(explained_kernels of, const terminal& t, explain_detail detail = {})
      : of_(std::move(of)), terminal_(t), detail_(detail), summary_(summary_head(t, of_.what.title)) {}

  /// `more`: what else is told of it; null: nothing.
  void print(const explained_increment& i, const explain_addition* more = nullptr);

  /// Behind the last increment: print what was kept, or the end of the summary.
  void finish();

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

  /// `more` as explain_text::print has it.
  void write(const explained_increment& i, const explain_addition* more = nullptr);

  /// Close the document.
  void finish(std::string_view status, const explained_path& path);

 private:
  explained_kernels of_;
  json_document document_;
};

}  // namespace contct::write
