// An explained run, for people and as JSON: what the listing did in each call, every sentence with the line
// that did it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/compare/explanation.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/result_json.hpp"

namespace contct::write {

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
  load_path loads{what};

  [[nodiscard]] bool wants(const explained_pair& p) const { return pair == 0 || pair == p.pair + 1; }
};

/// Prints increments, one at a time: the lines of the listing in the left margin, the paper's equations at
/// the right.
class explain_text {
 public:
  explain_text(explained_kernels of, const terminal& t) : of_(std::move(of)), terminal_(t) {}

  void print(const explained_increment& i);

 private:
  explained_kernels of_;
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
  json_document document_;
};

}  // namespace contct::write
