// Finds the line of the listing that another kernel has wrong, from its answers: the line whose fault gives
// the shortest description of all values that differ.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/compare/explanation.hpp"

namespace contct {

/// The least and the greatest of some numbers.
struct number_range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

/// A fault that one line of the listing can have. Its cost is the length, in bits, of a description of the
/// answers: at which executions the line went wrong, and the wrong values that follow no rule.
struct suspect {
  const listing_line* line = nullptr;
  std::int64_t reached = 0, wrong = 0;
  std::int64_t explained = 0;  ///< number of differing values that the fault explains
  double bits = 0.0;
  double last_ratio = not_an_answer;  ///< of a wrong value to the right one
  number_range compared;              ///< the number that an IF compares, where it went wrong

  /// One more execution: it went wrong, which explains so many values, or not.
  void count(bool goes_wrong, double bits_if_wrong, double bits_if_right = 0.0, std::int64_t values = 1);
  /// Values that differ, by one execution.
  void explain(double more_bits, std::int64_t values = 1);
};

/// The line with the least cost.
struct faulty_line {
  listing_line at;
  std::int64_t explained = 0, differ = 0;  ///< numbers of explained and of differing values
  std::int64_t calls = 0;                  ///< number of calls that differ
  std::string compared;                    ///< if `at` is an IF: "ABS(GAP) was 2e-10 to 9e-10"
};

/// For example "line 33, ELSE IF (ABS(GAP).LT.EPSGAP) THEN: explains all 12 values that differ, in 5 calls".
[[nodiscard]] std::string words_of(const faulty_line& f);

/// Describes the first pair that differs in SS, or else in ISEP: the numbers that decide its branches, and
/// the line that each kernel took, as far as the value shows it. Empty if no pair differs.
[[nodiscard]] std::string lines_taken(const answered_call& c, int real_bytes, const call_outputs& other,
                                      const std::string& leader, const std::string& follower);

/// Collects another kernel's answers to calls of one precision. Each result is judged by the other kernel's
/// own earlier results: SMIN by SS, and ISEP by SS and SMIN. The text is judged if all of these are right.
class fault_finder {
 public:
  /// Note the answer of another kernel, equal or not. Of equal and of differing calls the first thousand
  /// count.
  void note(const answered_call& c, int real_bytes, const call_outputs& other, bool equal);
  /// Returns nothing if no line explains a difference.
  [[nodiscard]] std::optional<faulty_line> found() const;
  /// The checksum of all 8-byte answers, computed as in reference/course/port/hint.py.
  [[nodiscard]] std::uint32_t digest() const { return digest_; }

 private:
  /// Less obvious faults of a line. Of two faults that cost the same the first is named.
  enum fault : std::uint8_t { usual, last_pair, wrong_sign, wrong_product, any_number, loop_left };

  suspect& at(const listing_line& line, fault kind = usual);
  template <class Real>
  void note_call(const call<Real>& c, const answered_call& right, const call_outputs& other);
  template <class Real>
  void note_pair(const call<Real>& c, const answered_call& right, std::size_t i, Real got);
  template <class Real>
  void note_loop(const call<Real>& c, std::span<const double> ss);
  void note_smallest(const call_outputs& other);
  template <class Real>
  void note_toggles(const answered_call& right, const call_outputs& other);
  void note_toggle(int before, int got, double diff, const std::optional<change>& told, bool has_text);
  void note_text(const answered_call& right, const call_outputs& other);
  void note_digest(const call_outputs& other);

  std::vector<suspect> suspects_ = std::vector<suspect>(10 * (listing::format_60.number + 1));
  std::int64_t equal_calls_ = 0, differing_calls_ = 0, pairs_ = 0, differ_ = 0;
  std::uint32_t digest_ = 2166136261U;
  std::vector<suspect*> left_by_;      // suspects that explain where this call's DO 10 loop was left
  std::map<int, int> set_to_;          // by status, what the other's lines 55 and 58 set
  std::map<int, bool> separated_;      // by status, how the other's IF (ISEP(I).EQ.1) went
  number_range diffs_in_, diffs_out_;  // DIFF, by how the other's IF (DIFF.LT.EPSMUL) went
};

}  // namespace contct
