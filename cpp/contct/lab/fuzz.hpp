// A fuzz run: kernels compared on random and adversarial calls and on whole problems, with mismatches shrunk.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/compare/lockstep.hpp"
#include "contct/kernel/registry.hpp"

namespace contct {

/// Calls in order; the answers to the last one differ. More than one where a kernel keeps something from call
/// to call.
using call_sequence = std::vector<call_inputs<double>>;

/// Does the last call of a sequence still differ in the same way when new kernels answer the whole sequence?
using still_differs = std::function<bool(const call_sequence&)>;

/// Make `calls` smaller while it still differs: first fewer calls, then fewer pairs, then nodes numbered
/// from 1 with one dof each, then rounder numbers. The result differs, too, whenever `calls` does.
/// `most_tries` bounds the work.
[[nodiscard]] call_sequence shrink(call_sequence calls, const still_differs& differs, int most_tries = 4000);

/// A mismatch with the calls that show it.
struct found_case {
  mismatch_report what;  ///< of the last call
  call_sequence calls;
  std::vector<call_outputs> leader;  ///< the leader's answers [calls]
};

/// A follower that has not been asked anything yet.
using fresh_kernel = std::function<std::unique_ptr<kernel>()>;

/// Put `calls` to the leader and to a fresh follower. The mismatch in the last call, when there is one
/// in that `field` ("" takes any), with the leader's answers.
[[nodiscard]] std::optional<found_case> reproduce(kernel& leader, const fresh_kernel& make,
                                                  const call_sequence& calls, const std::string& field);

/// `calls` shrunk while they differ in the same field. Nothing when they do not differ at all.
[[nodiscard]] std::optional<found_case> shrunk_case(kernel& leader, const fresh_kernel& follower,
                                                    const call_sequence& calls, const std::string& field,
                                                    int most_tries = 4000);

/// Which calls and problems: numbers I, I + N, ... of shard I/N.
struct fuzz_request {
  std::vector<std::string> kernels = {"fortran", "cpp"};  ///< the first leads
  std::int64_t calls = 200'000;
  std::int64_t problems = 400;
  std::uint64_t seed = 1989;
  int shard = 1, shards = 1;
};

/// The levels of equality, highest first.
enum class equality_level {
  bits,         ///< every answer equal to the bit, text included
  ulps,         ///< the same events, numbers within a few ULP
  events,       ///< the same pairs toggled in every call
  certificate,  ///< other events, but its own paths certified wherever the leader's are
  none,
};
[[nodiscard]] std::string_view name_of(equality_level l);

/// The results of the calls to one follower.
struct fuzz_follower {
  std::string name;
  tally compared;
  nearness near;
  equality_level highest = equality_level::bits;
  std::optional<faulty_line> at_fault;        ///< by all mismatches
  std::vector<std::string> mismatch_reports;  ///< the first mismatch, in lines
};

/// Events by kind. A pair at its face when its event came is counted as stationary, too.
struct event_counts {
  std::int64_t make = 0, break_ = 0, stationary = 0;
};

/// The results of a run, or of a shard of one. Its calls are single ones and those of all paths.
struct fuzz_result {
  fuzz_request request;
  std::int64_t calls = 0, problems = 0;
  event_counts events;  ///< of the leader
  branch_counts branches;
  std::vector<fuzz_follower> followers;
  double seconds = 0.0;

  /// Count a call that the leader answered.
  void count(const call<double>& answered, std::span<const int> isep_before);
  [[nodiscard]] tally compared() const;
};

/// Checks that a run compared enough for "no mismatch" to mean something: empty if it did, otherwise the
/// missing counts. Below 1000 calls it is enough that something was compared.
[[nodiscard]] std::string floors_missed(const fuzz_result& r);

/// A result, and the cases that were found.
struct fuzz_run {
  fuzz_result result;
  std::vector<found_case> cases;  ///< one for each follower that differed, shrunk
};

/// Progress: work done out of all, in calls or problems.
using fuzz_progress = std::function<void(std::int64_t done, std::int64_t all, const char* what)>;

/// Put the calls and problems of `r` to its kernels. Throws std::invalid_argument for kernels that are
/// unknown, or of another precision or rule. `make` knows them by their names.
[[nodiscard]] fuzz_run run_fuzz(const fuzz_request& r, const fuzz_progress& progress = nullptr,
                                const kernel_maker& make = make_kernel);

/// The result as JSON, format "contct-fuzz-1".
[[nodiscard]] std::string fuzz_json(const fuzz_result& r);

/// The calls of a case with the leader's answers, as a trace. `h` says whose they are.
[[nodiscard]] std::string trace_of(const found_case& c, trace_header h);

}  // namespace contct
