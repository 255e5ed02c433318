// Finds the line of the listing that another kernel has wrong, from its answers: the line whose fault gives
// the shortest description of all values that differ.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/compare/explanation.hpp"

namespace contct {

/// A possible fault of one line of the listing. Its cost is the number of bits that describe the answers: the
/// executions in which the line is wrong, and the wrong values that follow no rule.
struct suspect {
  std::int64_t reached = 0, wrong = 0;
  std::int64_t explained = 0;  ///< number of differing values that the fault explains
  double bits = 0.0;
  double last_value = not_an_answer, last_ratio = not_an_answer;  ///< of the last wrong number
  double least = 0.0, most = 0.0;  ///< range of the number that the IF compares when it is wrong
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
  fault_finder();

  /// Adds an answer of the other kernel. Uses only the first 1000 equal and the first 1000 differing answers.
  void note(const answered_call& c, int real_bytes, const call_outputs& other, bool equal);
  /// Returns nothing if no line explains a difference.
  [[nodiscard]] std::optional<faulty_line> found() const;
  /// The checksum of all 8-byte answers, computed as in reference/course/port/hint.py.
  [[nodiscard]] std::uint32_t digest() const { return digest_; }

 private:
  template <class Real>
  void note_call(const call<Real>& c, const answered_call& right, const call_outputs& other);
  template <class Real>
  void note_scale_factors(const call<Real>& c, const answered_call& right, const call_outputs& other);
  template <class Real>
  void note_pair(const call<Real>& c, const answered_call& right, std::size_t i, Real got);
  template <class Real>
  void note_loop(const call<Real>& c, const answered_call& right, std::span<const double> ss);
  template <class Real>
  void note_smallest(const call_outputs& other);
  template <class Real>
  void note_toggles(const answered_call& right, const call_outputs& other);
  template <class Real>
  void note_toggle(int before, int got, Real diff, const std::optional<change>& told, bool has_text);
  void note_text(const answered_call& right, const call_outputs& other);
  void note_digest(const call_outputs& other);

  std::vector<suspect> suspects_;
  std::int64_t equal_calls_ = 0, differing_calls_ = 0, pairs_ = 0, differ_ = 0;
  std::uint32_t digest_ = 2166136261U;
  double last_smin_ = not_an_answer;
  std::vector<std::size_t> left_by_;  // suspects that explain the pair at which this call left its DO 10 loop
  std::map<int, int> set_to_;         // the ISEP that the other kernel sets, by the status before
  std::map<int, bool> separated_;     // the other kernel's IF (ISEP(I).EQ.1), by the status before
  // The range of DIFF for each outcome of the other kernel's IF (DIFF.LT.EPSMUL).
  double least_true_ = std::numeric_limits<double>::infinity();
  double most_true_ = -std::numeric_limits<double>::infinity();
  double least_false_ = std::numeric_limits<double>::infinity();
  double most_false_ = -std::numeric_limits<double>::infinity();
};

}  // namespace contct
