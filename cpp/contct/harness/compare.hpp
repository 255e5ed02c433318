// Compares the answers of two kernels to the same calls, to the bit. The leader's calls come from a path or
// from a trace; the follower repeats these calls.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/harness/branches.hpp"
#include "contct/harness/faulty_line.hpp"
#include "contct/kernel/trace.hpp"
#include "contct/number/bits.hpp"

namespace contct {

/// The numbers of an answer.
struct answer {
  answer(const call<double>& c) : smin(c.smin), ss(c.ss), isep(c.isep) {}  // NOLINT: a call is an answer
  answer(const call_outputs& o) : smin(o.smin), ss(o.ss), isep(o.isep) {}  // NOLINT: and so are outputs

  double smin;
  std::span<const double> ss;
  std::span<const int> isep;
};

/// The first difference between two answers, in the order SMIN, SS, ISEP, unit-26 text.
struct mismatch {
  std::string field;       ///< "SMIN", "SS", "ISEP" or "text"; "answer" if the follower gave none
  int index = 0;           ///< pair, from 1, for SS and ISEP; line, from 1, for the text; else 0
  std::string leader;      ///< the leader's value; SMIN and SS in hexfloat
  std::string follower;    ///< the follower's value
  std::uint64_t ulps = 0;  ///< distance of the two values; 0 for ISEP and the text
};

/// Returns the decision with the smallest margin among the IFs in the leader's call `c` that can have caused
/// the first difference of the answer `other`: for SS(i) the IFs that choose the formula of SS(i); for SMIN
/// the IFs that choose the smallest SS; for ISEP(i) and the text the IFs after the DO 10 loop. Returns
/// IF (ISEP(I).EQ.1) only if no other IF counts, and nothing if the difference depends on no IF.
[[nodiscard]] std::optional<decision> narrowest_decision(const answered_call& c, int real_bytes,
                                                         const call_outputs& other);

/// Describes the first pair that differs in SS, or else in ISEP: its GAP, DTEST and SSCHK, and the line that
/// each kernel took, as far as the kernel's value shows. Empty if no pair differs.
[[nodiscard]] std::string lines_taken(const answered_call& c, int real_bytes, const call_outputs& other,
                                      const std::string& leader, const std::string& follower);

struct tally {
  std::int64_t values = 0;
  std::int64_t mismatches = 0;

  tally& operator+=(const tally& other) {
    values += other.values;
    mismatches += other.mismatches;
    return *this;
  }
};

/// Returns the first difference of two answers of equal length, and adds the numbers of values and of
/// mismatches to `t`. NaN equals NaN; -0.0 differs from +0.0.
std::optional<mismatch> compare_answers(const answer& leader, const answer& follower, tally& t);

/// Returns the first line in which two unit-26 texts differ: byte for byte or, `by_meaning`, word by word;
/// then .25 equals 0.25, because f2c omits the zero. Counts the texts as one value in `t`.
std::optional<mismatch> compare_text(std::string_view leader, std::string_view follower, tally& t,
                                     bool by_meaning = false);

/// True if the texts of these kernels are compared by meaning.
[[nodiscard]] inline bool texts_by_meaning(const kernel_facts& leader, const kernel_facts& follower) {
  return leader.text_by_meaning || follower.text_by_meaning;
}

/// A call in which a follower's answer differs from the leader's.
struct mismatch_report {
  std::int64_t call = 0;  ///< from 1
  std::string leader;     ///< name of the kernel
  std::string follower;   ///< name of the kernel
  mismatch where;
  std::optional<decision> narrowest;  ///< see narrowest_decision
  std::string lines = {};             ///< see lines_taken
};

/// The lines of a report: the difference, for example "call 7: mine differs in SS(3): fortran has 0x1p-1 =
/// 0.5, mine has 0x1p-2 = 0.25 (4503599627370496 ULP)"; the narrowest decision; and `lines` unless empty. If
/// the follower gave no answer, one line says so.
[[nodiscard]] std::vector<std::string> words_of(const mismatch_report& f);

/// Throws std::invalid_argument if the kernels differ in precision or rule, because their answers then cannot
/// be equal to the bit.
void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower);

/// The comparison of a follower's answer with the leader's in one call.
struct follower_answer {
  std::int64_t values = 0, mismatches = 0;
  std::uint64_t smin_ulps = 0;  ///< distance of SMIN
  std::uint64_t ss_ulps = 0;    ///< largest distance of an SS
  bool failed = false;          ///< the kernel gave no answer
};

/// The size of a kernel's differences from the leader, over all calls.
struct nearness {
  std::uint64_t most_ulps = 0;  ///< largest distance of SMIN or SS
  bool same_events = true;      ///< ISEP was equal in all calls, and every call was answered
  bool always_answered = true;
};

/// The levels of equality, highest first.
enum class equality_level {
  bits,         ///< every answer equal to the bit, text included
  ulps,         ///< the same events, numbers within a few ULP
  events,       ///< the same pairs toggled in every call
  certificate,  ///< other events, but the follower's paths are certified where the leader's are
  none,
};
[[nodiscard]] std::string_view name_of(equality_level l);

/// Returns the highest level that the compared answers reach; never `certificate`, which depends on paths.
[[nodiscard]] equality_level level_of(const nearness& n, const tally& compared);

/// Repeats the calls of a leader with a kernel, counts the compared values, and keeps the first mismatch.
class follower {
 public:
  /// `k` must outlive this object.
  follower(kernel_facts leader, kernel& k);

  /// Repeats a call of the leader, compares SMIN, SS and ISEP, and also the text if both kernels write text,
  /// and returns the first difference. A kernel that fails has one mismatch, in the field "answer". Throws
  /// std::invalid_argument if refuse_beyond_limits refuses the call.
  const std::optional<mismatch>& ask(const answered_call& c);
  /// Returns the report of `found`, a mismatch in the last call, `c`.
  [[nodiscard]] mismatch_report report_of(const mismatch& found, const answered_call& c) const;

  [[nodiscard]] kernel& asked() const { return *kernel_; }
  /// The kernel's outputs in the last call.
  [[nodiscard]] const call_outputs& answer() const { return answer_; }
  /// The first difference of answer() from the leader's outputs.
  [[nodiscard]] const std::optional<mismatch>& difference() const { return difference_; }
  [[nodiscard]] const follower_answer& last() const { return last_; }
  [[nodiscard]] bool answered() const { return !last_.failed; }
  [[nodiscard]] const std::optional<mismatch_report>& first() const { return first_; }
  tally compared;
  nearness near;
  fault_finder faults;

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

/// The default kernel for a trace: the 1989 code in the trace's precision or, for a trace of the corrected
/// rule, the corrected kernel.
[[nodiscard]] inline std::string usual_kernel(const trace_header& h) {
  if (h.rule == contact_rule::corrected) return "corrected";
  return h.real_bytes == 4 ? "fortran-r4" : "fortran";
}

/// The follower that repeats the calls of a trace with the header `h` by `k`. It compares unit-26 text if the
/// trace has text and `k` writes text: by meaning if the trace or `k` is from f2c.
[[nodiscard]] follower follower_of(const trace_header& h, kernel& k);

/// Repeats the remaining calls of a trace with `f`, and returns their number. `asked` receives each call
/// after the answer. Throws input_error if the trace is malformed.
std::int64_t replay(
    trace_reader& calls, follower& f,
    const std::function<void(const recorded_call& c, const answered_call& right)>& asked = nullptr);

}  // namespace contct
