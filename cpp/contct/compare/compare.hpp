// Tier 1: are two answers to one call equal to the bit? A kernel that is asked each call of a leader after
// it, or each recorded call.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/compare/branches.hpp"
#include "contct/compare/faulty_line.hpp"
#include "contct/kernel/trace.hpp"
#include "contct/number/bits.hpp"

namespace contct {

/// The compared part of a kernel's answer.
template <class Real>
struct answer {
  Real smin;
  std::span<const Real> ss;
  std::span<const int> isep;
};

/// The first difference of two answers: SMIN, then SS, then ISEP, then the text.
struct mismatch {
  std::string field;       ///< "SMIN", "SS", "ISEP" or "text"
  int index = 0;           ///< pair, from 1, for SS and ISEP; line, from 1, for the text; else 0
  std::string leader;      ///< the leader's value, numbers in hexfloat
  std::string follower;    ///< the follower's
  std::uint64_t ulps = 0;  ///< distance of two numbers; 0 for ISEP and the text
};

/// The narrowest decision of the leader's call on which the difference of another answer to it depends, given
/// what comes before it and is equal: for SS(i) the IFs that choose it; for SMIN, if no SS differs, those
/// that choose the smallest; for ISEP(i) and the text the decisions from SMIN and SS. Nothing if every IF was
/// decided alike.
[[nodiscard]] std::optional<decision> narrowest_decision(const answered_call& c, int real_bytes,
                                                         const call_outputs& other);

/// How many values have been compared, and how many of them differed.
struct tally {
  std::int64_t values = 0;
  std::int64_t mismatches = 0;

  tally& operator+=(const tally& other) {
    values += other.values;
    mismatches += other.mismatches;
    return *this;
  }
};

/// Have both answers, of equal length, the same bytes? Then their values are equal; a NaN of another payload
/// makes this false, and is equal all the same.
template <class Real>
[[nodiscard]] bool same_bytes(const answer<Real>& a, const answer<Real>& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.empty() || std::memcmp(x.data(), y.data(), x.size_bytes()) == 0;
  };
  return same_bits(a.smin, b.smin) && same(a.ss, b.ss) && same(a.isep, b.isep);
}

/// Compare two answers of equal length, value by value. NaN equals NaN; -0.0 is not +0.0.
template <class Real>
std::optional<mismatch> compare_answers(const answer<Real>& leader, const answer<Real>& follower, tally& t) {
  t.values += 1 + static_cast<std::int64_t>(leader.ss.size() + leader.isep.size());
  if (same_bytes(leader, follower)) return std::nullopt;
  std::optional<mismatch> first;
  const auto differ = [&](std::string field, std::size_t index, std::string a, std::string b,
                          std::uint64_t ulps) {
    ++t.mismatches;
    if (!first) first = mismatch{std::move(field), static_cast<int>(index), std::move(a), std::move(b), ulps};
  };
  const auto real = [&](const char* field, std::size_t index, Real a, Real b) {
    if (!same_bits(a, b)) differ(field, index, hexfloat(a), hexfloat(b), ulps_between(a, b));
  };
  real("SMIN", 0, leader.smin, follower.smin);
  for (std::size_t i = 0; i < leader.ss.size(); ++i) real("SS", i + 1, leader.ss[i], follower.ss[i]);
  for (std::size_t i = 0; i < leader.isep.size(); ++i) {
    if (leader.isep[i] != follower.isep[i]) {
      differ("ISEP", i + 1, std::to_string(leader.isep[i]), std::to_string(follower.isep[i]), 0);
    }
  }
  return first;
}

/// How unit 26 text is compared.
enum class text_equality {
  bytes,   ///< byte for byte
  meaning  ///< word by word, line by line; .25 is 0.25: libf2c leaves that zero out
};

/// Compare unit-26 text, as one value.
std::optional<mismatch> compare_text(std::string_view leader, std::string_view follower, tally& t,
                                     text_equality equality = text_equality::bytes);

/// How the text of two kernels is compared.
[[nodiscard]] inline text_equality text_equality_of(const kernel_facts& leader,
                                                    const kernel_facts& follower) {
  return leader.text_by_meaning || follower.text_by_meaning ? text_equality::meaning : text_equality::bytes;
}

/// The first call in which a follower did not answer as the leader.
struct mismatch_report {
  std::int64_t call = 0;  ///< from 1
  std::string leader;     ///< names of the kernels
  std::string follower;
  mismatch where;
  std::optional<decision> narrowest;  ///< of the leader in that call, on which the difference depends
  std::string lines = {};             ///< as lines_taken
};

/// "call 7: mine differs in SS(3): fortran has 0x1p-1 = 0.5, mine has 0x1p-2 = 0.25 (4503599627370496 ULP)";
/// its branch margin: the narrowest decision on which that depends, and what follows from it; lines_taken, if
/// any.
[[nodiscard]] std::vector<std::string> words_of(const mismatch_report& f);

/// Throws std::invalid_argument when the two differ in precision or rule: their answers cannot be
/// equal to the bit.
void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower);

/// How a follower answered one call of the leader.
struct follower_answer {
  std::int64_t values = 0, mismatches = 0;
  std::uint64_t smin_ulps = 0;  ///< distance of SMIN
  std::uint64_t ss_ulps = 0;    ///< largest distance of an s
  bool failed = false;          ///< it gave no answer
};

/// The differences of a kernel that is not equal to the bit, over all calls.
struct nearness {
  std::uint64_t most_ulps = 0;  ///< of SMIN and SS
  bool same_events = true;      ///< ISEP was equal in all calls, and every call was answered
  bool always_answered = true;
};

/// Repeats the calls of a leader with a kernel, counts the compared values, and keeps the first mismatch.
class follower {
 public:
  /// `k` must outlive this object. The leader's facts give the precision and the text of its calls.
  follower(kernel_facts leader, kernel& k);

  /// Ask a call that the leader answered, and compare SMIN, all of SS and all of ISEP; the text too, where
  /// the call has one and the kernel writes any. A kernel that fails has one mismatch, in the field "answer".
  /// Throws std::invalid_argument where the call is beyond the limits of refuse_beyond_limits.
  const std::optional<mismatch>& ask(const answered_call& c);
  /// Keep a mismatch that was found in a call, unless an earlier call has one.
  void note(const mismatch& found, const answered_call& c);
  /// A mismatch of the call that was asked last, with all that is known of it.
  [[nodiscard]] mismatch_report report_of(const mismatch& found, const answered_call& c) const;

  [[nodiscard]] kernel& asked() const { return *kernel_; }
  /// How its text is compared with the leader's.
  [[nodiscard]] text_equality equality() const { return text_equality_of(leader_, kernel_->facts()); }
  /// The outputs of the last call, and where they differ first from the leader's.
  [[nodiscard]] const call_outputs& answer() const { return answer_; }
  [[nodiscard]] const std::optional<mismatch>& difference() const { return difference_; }
  /// The difference of that answer from the leader's.
  [[nodiscard]] const follower_answer& last() const { return last_; }
  [[nodiscard]] bool answered() const { return !last_.failed; }
  [[nodiscard]] const std::optional<mismatch_report>& first() const { return first_; }
  tally compared;
  nearness near;
  fault_finder faults;  ///< has every answer

 private:
  std::optional<mismatch> compare(const answered_call& c);
  void measure(const call<double>& leader, const tally& before);

  kernel_facts leader_;
  kernel* kernel_;
  call_outputs answer_;
  std::optional<mismatch> difference_;
  follower_answer last_;
  std::optional<mismatch_report> first_;
};

/// The result of a replay.
struct replay_report {
  std::int64_t calls = 0;
  tally compared;
  branch_counts branches;
  nearness near;
  std::optional<mismatch_report> first;  ///< the first difference
  fault_finder faults;                   ///< has every answer, of this trace and those before it
};

/// Can a kernel with these facts be compared with the trace? Not with another precision or rule.
[[nodiscard]] bool comparable(const trace_header& h, const kernel_facts& k);

/// The kernel that is used if none is named: the 1989 code in the trace's precision, or the corrected rule.
[[nodiscard]] inline std::string usual_kernel(const trace_header& h) {
  if (h.rule == contact_rule::corrected) return "corrected";
  return h.real_bytes == 4 ? "fortran-r4" : "fortran";
}

/// Replay all remaining calls of `calls` with `k`, in order, and compare to the bit; the text too, if both
/// have it, by meaning if one of them is f2c. `progress` gets the number of calls done, after each. `before`
/// has the kernel's answers to earlier traces. Throws input_error where the trace is malformed.
[[nodiscard]] replay_report replay(const trace_header& h, trace_reader& calls, kernel& k,
                                   const std::function<void(std::int64_t)>& progress = nullptr,
                                   fault_finder before = {});

}  // namespace contct
