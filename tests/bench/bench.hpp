// The timed work of the benchmark: an engine on a problem, a call of a kernel, and CHOLMOD without an engine.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/model/structure.hpp"
#include "contct/path/observer.hpp"
#include "contct/solve/engine.hpp"

namespace bench {

/// A clock of this thread's processor time, which is correct on a busy machine too.
struct cpu_clock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<cpu_clock>;
  static constexpr bool is_steady = true;

  static time_point now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return time_point(std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec));
  }
};

/// Returns the problem file of a family and size, such as "rail-50". Throws std::invalid_argument for an
/// unknown name.
[[nodiscard]] std::string text_of(const std::string& name);
/// Returns the problem with the text text_of(name), or that of the file `name` if `name` ends in ".toml".
[[nodiscard]] contct::problem make_problem(const std::string& name);

/// Returns the names of the benchmark's problems, the smallest first.
[[nodiscard]] std::vector<std::string> usual_problems();

/// An event and its load: the number of finished steps plus the share of the current step.
struct timed_event {
  int pair;
  double load;
};

struct run_of_engine {
  double seconds = 0.0;  ///< from the start to the last event
  std::vector<timed_event> events;
  std::vector<double> displacement;  ///< at the end of the path [dofs]
  contct::engine_counts counts;
  long peak_kib = 0;  ///< peak memory of the process during this run
  bool whole = true;  ///< the path reached its end
  bool certified = false;
  double certificate_seconds = 0.0;  ///< seconds for refining and proving the last state
};

/// Follows the path under the corrected rule, with at most `most_events` events a step, or all if 0. If
/// `certify` is set and the path is complete, the last state is certified; certification is timed separately.
[[nodiscard]] run_of_engine run_engine(const contct::problem& p, const contct::linear_structure& s,
                                       const std::string& engine, int most_events, bool certify);

/// The cost of the final states of all steps, without a path and without a certificate.
struct final_states {
  double seconds = 0.0;
  int factorisations = 0;
  double seconds_of_a_factor = 0.0;  ///< by the library that the reference solution uses
};
[[nodiscard]] final_states time_final_states(const contct::problem& p, const contct::linear_structure& s);

/// Returns the seconds of one dpbtrs with the factor of the initial structure, the cost of a plain solve.
[[nodiscard]] double seconds_of_a_solve(const contct::linear_structure& s);

/// The difference between two runs in their common events.
struct difference {
  bool same_events = true;  ///< equal events, apart from the order at ties
  double load = 0.0;        ///< largest difference of an event's load
  double displacement =
      0.0;  ///< largest difference of D after equally many events, relative to the largest D
};
[[nodiscard]] difference difference_of(const run_of_engine& reference, const run_of_engine& other);

/// The least time in seconds of a call without an event, among `rounds` rounds. In a call without an event,
/// the listing writes a line of text; `fortran` excludes the time of a call without pairs, which only writes
/// this line.
struct seconds_of_a_call {
  double fortran;
  double cpp;
  double text;  ///< time of a call of the listing without pairs
};
[[nodiscard]] seconds_of_a_call time_kernels(std::size_t pairs, int rounds);

/// The time of CHOLMOD without an engine, and the comparison of CHOLMOD's result with our certified state.
struct peer_answer {
  std::string method;
  double seconds = 0.0;  ///< median processor time from K in memory to D
  double mib = 0.0;      ///< peak memory of CHOLMOD
  int steps = 0;         ///< steps of Newton's method, or events of the path
  double digits = 0.0;   ///< proved digits of the worst number, at most 15
  int wrong_statuses = 0;
  int values = 0;  ///< compared numbers
};

/// Times the whole path with an updated factor and, for a problem of one load step, Newton's method on K and
/// the springs of pressed pairs, once with an updated factor and once with a new factor for each step. The
/// problem must have no settlement, and each step goes on from the last. Returns nothing without
/// CHOLMOD. Throws std::runtime_error if our own final state is not certified. `only`: the method; empty:
/// all.
[[nodiscard]] std::vector<peer_answer> time_cholmod(const contct::problem& p,
                                                    const contct::linear_structure& s, int rounds,
                                                    const std::string& only);

}  // namespace bench
