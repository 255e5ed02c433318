// Compares the answers of two kernels to the same calls, to the bit. The leader's calls come from a path or
// from a trace; the follower repeats these calls.
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

template <class Real>
struct answer {
  Real smin;
  std::span<const Real> ss;
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
/// nothing if the difference depends on no IF.
[[nodiscard]] std::optional<decision> narrowest_decision(const answered_call& c, int real_bytes,
                                                         const call_outputs& other);

struct tally {
  std::int64_t values = 0;
  std::int64_t mismatches = 0;

  tally& operator+=(const tally& other) {
    values += other.values;
    mismatches += other.mismatches;
    return *this;
  }
};

/// A quick test: if true, two answers of equal length are equal. If false, they can still be equal, because
/// compare_answers does not distinguish the bits of NaN in SS.
template <class Real>
[[nodiscard]] bool same_bytes(const answer<Real>& a, const answer<Real>& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.empty() || std::memcmp(x.data(), y.data(), x.size_bytes()) == 0;
  };
  return same_bits(a.smin, b.smin) && same(a.ss, b.ss) && same(a.isep, b.isep);
}

/// Returns the first difference of two answers of equal length, and adds the numbers of values and of
/// mismatches to `t`. NaN equals NaN; -0.0 differs from +0.0.
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

/// How unit-26 text is compared.
enum class text_equality {
  bytes,   ///< byte for byte
  meaning  ///< word by word in each line; .25 equals 0.25, because f2c omits the zero
};

/// Returns the first line in which two unit-26 texts differ. Counts the texts as one value in `t`.
std::optional<mismatch> compare_text(std::string_view leader, std::string_view follower, tally& t,
                                     text_equality equality = text_equality::bytes);

[[nodiscard]] inline text_equality text_equality_of(const kernel_facts& leader,
                                                    const kernel_facts& follower) {
  return leader.text_by_meaning || follower.text_by_meaning ? text_equality::meaning : text_equality::bytes;
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
  /// Makes `found`, a mismatch in call `c`, the first mismatch, unless a mismatch in `c` or in an earlier
  /// call is known.
  void note(const mismatch& found, const answered_call& c);
  /// Returns the report of `found`, a mismatch in the last call, `c`.
  [[nodiscard]] mismatch_report report_of(const mismatch& found, const answered_call& c) const;

  [[nodiscard]] kernel& asked() const { return *kernel_; }
  [[nodiscard]] text_equality equality() const { return text_equality_of(leader_, kernel_->facts()); }
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

struct replay_report {
  std::int64_t calls = 0;
  tally compared;
  branch_counts branches;
  nearness near;
  std::optional<mismatch_report> first;
  fault_finder faults;  ///< has noted the answers to this trace and to earlier traces
};

/// True if the kernel has the precision and the rule of the trace.
[[nodiscard]] bool comparable(const trace_header& h, const kernel_facts& k);

/// The default kernel for a trace: the 1989 code in the trace's precision or, for a trace of the corrected
/// rule, the corrected kernel.
[[nodiscard]] inline std::string usual_kernel(const trace_header& h) {
  if (h.rule == contact_rule::corrected) return "corrected";
  return h.real_bytes == 4 ? "fortran-r4" : "fortran";
}

/// Repeats the remaining calls of the trace `calls` with `k` and compares the answers to the bit. Unit-26
/// text is compared if the trace has text and `k` writes text: by meaning if the trace or `k` is from f2c.
/// `progress` receives the number of finished calls. `before` has noted the kernel's answers to earlier
/// traces. Throws input_error if the trace is malformed.
[[nodiscard]] replay_report replay(const trace_header& h, trace_reader& calls, kernel& k,
                                   const std::function<void(std::int64_t)>& progress = nullptr,
                                   fault_finder before = {});

}  // namespace contct
