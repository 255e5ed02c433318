// A fuzz run compares kernels on random and adversarial calls and on whole problems, and reduces the
// calls that show a mismatch.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/harness/lockstep.hpp"
#include "contct/kernel/registry.hpp"

namespace contct {

/// Calls of which the last one shows a mismatch; several calls if the kernel keeps data between calls.
using call_sequence = std::vector<call_inputs>;

/// True if a new follower, after all earlier calls, still differs in the last call, in the same field.
using still_differs = std::function<bool(const call_sequence&)>;

/// Reduces `calls` to fewer calls, fewer pairs, nodes from 1 with one dof each, and rounder numbers. Keeps
/// only changes for which `differs` is true. Tests at most `most_tries` sequences.
[[nodiscard]] call_sequence shrink(call_sequence calls, const still_differs& differs, int most_tries = 4000);

struct found_case {
  mismatch_report what;              ///< the mismatch in the last call
  std::vector<recorded_call> calls;  ///< with the leader's answers
};

/// Makes a follower that has not answered a call yet.
using fresh_kernel = std::function<std::unique_ptr<kernel>()>;

/// Repeats `calls` with the leader and another kernel. Returns the mismatch in the last call if it is in
/// `field`, or in any field if `field` is "".
[[nodiscard]] std::optional<found_case> reproduce(kernel& leader, kernel& other, const call_sequence& calls,
                                                  const std::string& field);

/// Reduces `calls` to a shorter case that still differs in `field`; see shrink and reproduce. Returns nothing
/// if `calls` do not differ in `field`.
[[nodiscard]] std::optional<found_case> shrunk_case(kernel& leader, const fresh_kernel& follower,
                                                    const call_sequence& calls, const std::string& field,
                                                    int most_tries = 4000);

/// The calls and problems of a run. Shard I of N has the calls and problems I, I + N, I + 2 N, ..
struct fuzz_request {
  std::vector<std::string> kernels = {"fortran", "cpp"};  ///< the first is the leader
  std::int64_t calls = 200'000;
  std::int64_t problems = 400;
  std::uint64_t seed = 1989;
  int shard = 1, shards = 1;
};

/// Problems whose paths a run compares too, numbered from 1.
class fuzz_problems {
 public:
  virtual ~fuzz_problems() = default;
  /// Follows the path of a problem with `leader`, and passes each answered call to `called`.
  virtual void follow(std::int64_t number, kernel& leader,
                      const std::function<void(const answered_call&)>& called) const = 0;
  /// True if the path of `follower` has the same verdict as that of `leader`, or if the leader's path is
  /// neither certified nor truly without equilibrium.
  [[nodiscard]] virtual bool has_verdict_of(std::int64_t number, const fresh_kernel& leader,
                                            const fresh_kernel& follower) const = 0;
};

struct fuzz_follower {
  std::string name;
  tally compared;
  nearness near;
  equality_level highest = equality_level::bits;
  std::optional<faulty_line> at_fault;        ///< the faulty line, found from all answers
  std::vector<std::string> mismatch_reports;  ///< lines about the first mismatch
};

/// Counts of events. Each event is a make or a break, and is also stationary if the pair was at its face.
struct event_counts {
  std::int64_t make = 0, break_ = 0, stationary = 0;
};

/// The result of a run, or of one shard.
struct fuzz_result {
  fuzz_request request;
  std::int64_t calls = 0, problems = 0;  ///< `calls` counts random calls and the calls of paths
  event_counts events;                   ///< the leader's events
  branch_counts branches;
  std::vector<fuzz_follower> followers;
  double seconds = 0.0;

  void count(const call<double>& answered, std::span<const int> isep_before);
  [[nodiscard]] tally compared() const;
};

/// Returns a message with the counts of events and branches that are too low for "no mismatch" to be
/// evidence; empty if all are high enough. With fewer than 1000 calls, one compared value is enough.
[[nodiscard]] std::string floors_missed(const fuzz_result& r);

struct fuzz_run {
  fuzz_result result;
  std::vector<found_case> cases;  ///< the reduced mismatch of each follower, if reproducible
};

/// Receives the number of finished calls or problems, their total, and "calls" or "problems".
using fuzz_progress = std::function<void(std::int64_t done, std::int64_t all, const char* what)>;

/// Compares the kernels of `r` on its calls and on `problems`, where null means that there are none. `make`
/// makes a kernel by name. Throws std::invalid_argument if a kernel is unknown, or if the kernels differ in
/// precision or rule.
[[nodiscard]] fuzz_run run_fuzz(const fuzz_request& r, const fuzz_problems* problems,
                                const fuzz_progress& progress = nullptr,
                                const kernel_maker& make = make_kernel);

/// The result as JSON, format "contct-fuzz-1".
[[nodiscard]] std::string fuzz_json(const fuzz_result& r);

/// The calls of a case as a trace with the header `h`.
[[nodiscard]] std::string trace_of(found_case c, trace_header h);

}  // namespace contct
