// A fuzz run: random and adversarial calls and whole problems put to kernels, how equal these are, and
// mismatches shrunk.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/compare/compare.hpp"
#include "contct/trace/trace.hpp"

namespace contct::lab {

/// Calls in order; the answers to the last one differ. More than one where a kernel keeps something from call
/// to call.
using call_sequence = std::vector<call_inputs<double>>;

/// Does the last call of a sequence still differ, in the same way, when the whole is put to fresh kernels?
using still_differs = std::function<bool(const call_sequence&)>;

/// Make `calls` smaller while it still differs: first fewer calls, then fewer pairs, then nodes numbered
/// from 1 with one dof each, then rounder numbers. The result differs, too, whenever `calls` does.
/// `most_tries` bounds the work.
[[nodiscard]] call_sequence shrink(call_sequence calls, const still_differs& differs, int most_tries = 4000);

/// A mismatch with the calls that show it.
struct found_case {
  mismatch_report what;  ///< of the last call
  int real_bytes = 8;
  call_sequence calls;
  std::vector<call_outputs> leader;  ///< the leader's answers [calls]
};

/// Put `calls` to the leader and to a fresh follower. The mismatch in the last call, when there is one
/// in that `field` ("" takes any), with the leader's answers.
[[nodiscard]] std::optional<found_case> reproduce(kernel& leader, const std::string& follower,
                                                  const call_sequence& calls, const std::string& field);

/// `calls` shrunk while they differ in the same field. Nothing when they do not differ at all.
[[nodiscard]] std::optional<found_case> shrunk_case(kernel& leader, const std::string& follower,
                                                    const call_sequence& calls, const std::string& field,
                                                    int most_tries = 4000);

/// Events by kind. A pair at its face when its event came is counted as stationary, too.
struct event_counts {
  std::int64_t make = 0, break_ = 0, stationary = 0;
};

/// What the leader of a campaign did.
struct campaign_counts {
  std::int64_t calls = 0;
  branch_counts branches;
  event_counts events;

  /// Count a call that the leader answered.
  void count(const call<double>& answered, std::span<const int> isep_before);
  void add(const campaign_counts& other);
};

/// What came of the calls to one follower.
struct follower_result {
  tally compared;
  // How near it came where it was not equal to the bit:
  std::uint64_t most_ulps = 0;  ///< of SMIN and SS, over all calls
  bool same_events = true;      ///< ISEP was equal in all calls
  bool always_answered = true;
  std::optional<mismatch_report> first;  ///< the first mismatch
  call_sequence calls;                   ///< the calls up to it, 41 at most in a campaign of single calls

  /// Note how near the follower came in a call whose answer differs.
  void note_difference(const call<double>& leader, const follower& f);
  /// Add the result of other calls, which were put later.
  void add(const follower_result& other);
};

/// What came of a number of calls, or of the calls on the path of a problem.
struct campaign_result : campaign_counts {
  std::vector<follower_result> each;  ///< [followers]
};

/// Which calls and problems: numbers I, I + N, ... of shard I/N.
struct fuzz_request {
  std::vector<std::string> kernels = {"fortran", "cpp"};  ///< the first leads
  std::int64_t calls = 200'000;
  std::int64_t problems = 400;
  std::uint64_t seed = 1989;
  int shard = 1, shards = 1;

  friend bool operator==(const fuzz_request&, const fuzz_request&) = default;
};

/// Put the calls of `r`. SMIN, SS and ISEP are compared at once, the unit-26 text in blocks: reading it back
/// after every call would cost several times the call. Throws std::invalid_argument for kernels that are
/// unknown, or of another precision or rule.
[[nodiscard]] campaign_result put_calls(const fuzz_request& r);

/// The same of the calls with numbers `after` < number <= `last` alone.
[[nodiscard]] campaign_result put_calls(const fuzz_request& r, std::int64_t after, std::int64_t last);

/// Follow problem `number` with the leader, and put every call to the followers.
[[nodiscard]] campaign_result follow_in_lockstep(const fuzz_request& r, std::int64_t number);

/// Does the follower's own path of that problem end as well as the leader's: certified, or truly without
/// equilibrium? True where the leader's does not.
[[nodiscard]] bool certified_as_leader(const fuzz_request& r, std::int64_t number,
                                       const std::string& follower);

/// The levels of equality, highest first.
enum class equality_level {
  bits,         ///< every answer equal to the bit, text included
  ulps,         ///< the same events, numbers within a few ULP
  events,       ///< the same pairs toggled in every call
  certificate,  ///< other events, but its own paths certified wherever the leader's are
  none,
};
inline constexpr int equality_levels = 5;
[[nodiscard]] std::string_view name_of(equality_level l);

/// One follower's result.
struct fuzz_follower : follower_result {
  std::string name;
  equality_level highest = equality_level::bits;
  std::vector<std::string> mismatch_reports;  ///< the first mismatch, in lines
};

/// What came of a run or of a shard of one. Its calls are those of the call campaign and of all paths.
struct fuzz_result : campaign_counts {
  fuzz_request request;
  std::int64_t problems = 0;
  std::vector<fuzz_follower> followers;
  double seconds = 0.0;
  std::vector<int> merged_shards;  ///< of a merged result

  [[nodiscard]] tally compared() const;
};

/// What a run must have compared before "no mismatch" means anything: empty when it has, else what is
/// missing. Below 1000 calls only that anything was compared.
[[nodiscard]] std::string floors_missed(const fuzz_result& r);

/// A result, and the cases that were found.
struct fuzz_run {
  fuzz_result result;
  std::vector<found_case> cases;  ///< one for each follower that differed, shrunk
};

/// Progress: work done out of all, in calls or problems.
using fuzz_progress = std::function<void(std::int64_t done, std::int64_t all, const char* what)>;

/// How far a run has come: what another process needs to go on from there.
struct fuzz_checkpoint {
  /// Where a follower differed first: in a call of a problem, or in a single call.
  struct mark {
    std::int64_t problem = 0;  ///< 0: a single call
    std::int64_t call = 0;     ///< 0: it did not differ
  };

  fuzz_result result;            ///< of all that is done, seconds too
  std::int64_t calls_up_to = 0;  ///< calls to this number are done
  std::int64_t problems_up_to = 0;
  std::vector<std::int64_t> differing_problems;  ///< 40 at most
  std::vector<mark> firsts;                      ///< [followers]
};

/// Where a run keeps how far it has come.
struct fuzz_keeper {
  std::optional<fuzz_checkpoint> from;                       ///< to go on from; of the same request
  std::function<void(const fuzz_checkpoint& reached)> keep;  ///< called every few thousand calls
};

/// Put the calls and problems of `r` to its kernels, in `jobs` processes (0: one for each processor); the
/// kernels are made anew every few thousand calls. Neither `jobs` nor a keeper changes the result. Throws
/// std::invalid_argument for kernels that cannot be compared.
[[nodiscard]] fuzz_run run_fuzz(const fuzz_request& r, const fuzz_progress& progress = nullptr,
                                const fuzz_keeper& keeper = {}, int jobs = 1);

/// A checkpoint as JSON, format "contct-fuzz-checkpoint-1".
[[nodiscard]] std::string checkpoint_json(const fuzz_checkpoint& reached);

/// Read the checkpoint of a run of `r`. Throws input_error where the file is none, or one of another run.
[[nodiscard]] fuzz_checkpoint checkpoint_from(const std::string& file, const fuzz_request& r);

/// The result as JSON, format "contct-fuzz-1".
[[nodiscard]] std::string fuzz_json(fuzz_result r);

/// Read the results of all shards of one run and add them up. Throws input_error when one is no such file,
/// when they are not of one run, or when a shard is missing or given twice.
[[nodiscard]] fuzz_result merged_fuzz(const std::vector<std::string>& files);

/// The calls of a case with the leader's answers, as a trace. `h` says whose they are.
[[nodiscard]] std::string trace_of(const found_case& c, trace_header h);

/// A TEST_CASE that asks the follower and expects the leader's answer.
[[nodiscard]] std::string catch_test_of(const found_case& c);

/// A main program in fixed-form FORTRAN 77 that calls CONTCT and prints what it gives; the expected
/// values stand in its comments. Whoever has a FORTRAN compiler can run it.
[[nodiscard]] std::string fortran_main_of(const found_case& c);

}  // namespace contct::lab
