// Finds the faulty line of the listing in another kernel from all of its answers: the line that explains
// every value that differs, with the shortest description.
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

/// A fault that one line of the listing can have. Its cost is the length, in bits, of a description of the
/// answers: at which executions the line went wrong, and the wrong values that follow no rule.
struct suspect {
  std::int64_t reached = 0, wrong = 0;
  std::int64_t explained = 0;  ///< values that differ
  double bits = 0.0;
  double last_value = not_an_answer, last_ratio = not_an_answer;  ///< of its wrong values
  double least = 0.0, most = 0.0;  ///< of the number that an IF compares, where it went wrong
};

/// The line of least cost.
struct faulty_line {
  listing_line at;
  std::int64_t explained = 0, differ = 0;  ///< values
  std::int64_t calls = 0;                  ///< that differ
  std::string compared;                    ///< of an IF: "ABS(GAP) was 2e-10 to 9e-10"; or empty
};

/// "line 33, ELSE IF (ABS(GAP).LT.EPSGAP) THEN: explains all 12 values that differ, in 5 calls".
[[nodiscard]] std::string words_of(const faulty_line& f);

/// For the first pair that differs in SS, else in ISEP: the numbers that decide its branches, and the line
/// that each kernel took; of the other kernel only if its value shows it. Empty if neither differs.
[[nodiscard]] std::string lines_taken(const answered_call& c, int real_bytes, const call_outputs& other,
                                      const std::string& leader, const std::string& follower);

/// Looks at answers to calls of one precision. A stage of the listing is judged from the other kernel's
/// results of the stages before it: SMIN by its SS, ISEP by its SS and SMIN, the text where all of these are
/// right.
class fault_finder {
 public:
  fault_finder();

  /// Note the answer of another kernel, equal or not. Of equal and of differing calls the first thousand
  /// count.
  void note(const answered_call& c, int real_bytes, const call_outputs& other, bool equal);
  /// Nothing if there is no difference, or none that a line explains.
  [[nodiscard]] std::optional<faulty_line> found() const;
  /// The checksum of all noted answers, computed as in reference/course/port/hint.py.
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
  std::vector<std::size_t> left_by_;  // suspects that explain where this call's DO 10 loop was left
  std::map<int, int> set_to_;         // by status, what the other's lines 55 and 58 set
  std::map<int, bool> separated_;     // by status, how the other's IF (ISEP(I).EQ.1) went
  // DIFF, by how the other's IF (DIFF.LT.EPSMUL) went.
  double least_true_ = std::numeric_limits<double>::infinity();
  double most_true_ = -std::numeric_limits<double>::infinity();
  double least_false_ = std::numeric_limits<double>::infinity();
  double most_false_ = -std::numeric_limits<double>::infinity();
};

}  // namespace contct
