// Finds the line of the listing that a kernel has wrong, from the kernel's answers: the line with the fault
// that gives the shortest description of all wrong values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/harness/explanation.hpp"

namespace contct {

struct number_range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  [[nodiscard]] bool is_apart_from(const number_range& o) const { return most < o.least || o.most < least; }
};

/// A fault that one line of the listing can have. The cost of a fault is the length in bits of a description
/// of the wrong answers: which executions of the line went wrong, and which values the wrong executions gave.
struct suspect {
  const listing_line* line = nullptr;
  std::int64_t reached = 0, wrong = 0;        ///< numbers of executions, and of wrong executions
  std::int64_t explained = 0;                 ///< number of differing values that the fault explains
  double bits = 0.0;                          ///< the cost, without the list of wrong executions
  double last_ratio = not_an_answer;          ///< ratio of the last wrong value to the right value
  number_range compared;                      ///< range of the numbers that an IF compared when it went wrong
  number_range spared;                        ///< the same when it rightly went to line 38
  number_range compared_sizes, spared_sizes;  ///< the same for the absolute numbers

  /// Counts an execution. If the line went wrong, this costs `bits_if_wrong` and explains `values` differing
  /// values; otherwise it costs `bits_if_right`.
  void count(bool goes_wrong, double bits_if_wrong, double bits_if_right = 0.0, std::int64_t values = 1);
  /// Counts `values` differing values that one wrong execution explains, at a cost of `more_bits`.
  void explain(double more_bits, std::int64_t values = 1);
};

/// The line with the fault of the least cost.
struct faulty_line {
  listing_line at;                         ///< listing::flushing: no line, but the arithmetic
  std::int64_t explained = 0, differ = 0;  ///< numbers of explained and of differing values
  std::int64_t calls = 0;                  ///< number of calls that differ, 1000 at most
  std::string compared;                    ///< if `at` is an IF: "in these ABS(GAP) was 2e-10 to 9e-10"
};

/// For example "line 30, GAP = CC(I) - DD(NDOF)".
[[nodiscard]] std::string cited(const listing_line& line);

/// For example "line 30, GAP = CC(I) - DD(NDOF): explains all 12 values that differ, in 5 calls".
[[nodiscard]] std::string words_of(const faulty_line& f);

/// Collects a kernel's answers to calls of one precision, and finds the faulty line. SMIN is judged by the
/// kernel's SS, and ISEP by the kernel's SS and SMIN, so that a fault does not make later results wrong. The
/// text is judged if SS, SMIN and ISEP are right.
class fault_finder {
 public:
  /// Notes the kernel's answer `other`; `equal` tells whether `other` equals the right answer in `c`. Only
  /// the first 1000 equal and the first 1000 differing calls are judged, with about 200 000 pairs at most.
  void note(const answered_call& c, int real_bytes, const call_outputs& other, bool equal);
  /// The faulty line; nothing if no line explains a difference.
  [[nodiscard]] std::optional<faulty_line> found() const;
  /// The checksum of all 8-byte answers, computed as in reference/course/port/hint.py.
  [[nodiscard]] std::uint32_t digest() const { return digest_; }

 private:
  /// Kinds of faults of a line. Of faults with equal cost, found() names the fault of the earliest line.
  enum fault : std::uint8_t { usual, last_pair, wrong_sign, wrong_product, any_number, loop_left, other_way };

  /// `way`: numbers the other ways to compute what the line computes.
  suspect& at(const listing_line& line, fault kind = usual, std::size_t way = 0);
  template <class Real>
  void note_call(const call<Real>& c, const answered_call& right, const call_outputs& other);
  template <class Real>
  void note_pair(const call<Real>& c, const answered_call& right, std::size_t i, Real got);
  template <class Real>
  std::int64_t note_left_out(const call<Real>& c, std::span<const double> ss, double unset, std::size_t way);
  template <class Real>
  void note_loop(const call<Real>& c, std::span<const double> ss);
  void note_smallest(const call_outputs& other);
  template <class Real>
  void note_toggles(const answered_call& right, const call_outputs& other);
  void note_toggle(int before, int got, double diff, const std::optional<change>& told, bool has_text);
  void note_other_diffs(double s, double smin, bool went_in);
  void note_text(const answered_call& right, const call_outputs& other);
  void note_flushing(const answered_call& right, const call_outputs& other, std::int64_t differ);
  void note_digest(const call_outputs& other);

  static constexpr std::size_t faults_of_line = 16;  // kinds and ways
  std::vector<suspect> suspects_ =
      std::vector<suspect>(faults_of_line * (std::size_t{listing::format_60.number} + 1));
  std::int64_t equal_calls_ = 0, differing_calls_ = 0, pairs_ = 0, differ_ = 0;
  std::uint32_t digest_ = 2166136261U;
  std::vector<suspect*> left_by_;      // suspects that explain where the kernel left DO 10 in this call
  std::map<int, int> set_to_;          // old ISEP -> the new ISEP that line 55 or 58 set first
  std::map<int, bool> separated_;      // old ISEP -> the first outcome of IF (ISEP(I).EQ.1)
  number_range diffs_in_, diffs_out_;  // DIFF where IF (DIFF.LT.EPSMUL) was true, and false
};

}  // namespace contct
