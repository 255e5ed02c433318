// The timed work of the benchmark: one engine on one problem, one call of a kernel, and CHOLMOD by itself.
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

/// The time that this thread has been at work: the same as a watch's on a quiet machine, and still right on a
/// busy one.
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

/// The problem file of "rail-50", "mat-100", "grid-50": the family and its size. Throws std::invalid_argument
/// for others.
[[nodiscard]] std::string text_of(const std::string& name);
/// The same problem, or that of a file whose name ends in ".toml".
[[nodiscard]] contct::problem make_problem(const std::string& name);

/// The problems of the benchmark, smallest first.
[[nodiscard]] std::vector<std::string> usual_problems();

/// An event and the share of the load at which it came: steps already done plus the share of the one under
/// way.
struct timed_event {
  int pair;
  double load;
};

/// The result of one run of one engine.
struct run_of_engine {
  double seconds = 0.0;  ///< from the start to the last event
  std::vector<timed_event> events;
  std::vector<double> displacement;  ///< at the end [dofs]
  contct::engine_counts counts;
  long peak_kib = 0;  ///< of the process while this engine ran
  bool whole = true;  ///< the path came to its end
  bool certified = false;
  double certificate_seconds = 0.0;  ///< of the last state: refined and proved
};

/// Follow the path under the corrected rule. `most_events` in a step, 0: all. The certificate is computed if
/// `certify` is set and the path is complete; its time is measured separately.
[[nodiscard]] run_of_engine run_engine(const contct::problem& p, const contct::linear_structure& s,
                                       const std::string& engine, int most_events, bool certify);

/// The ends of all steps without a path, and without a certificate.
struct final_states {
  double seconds = 0.0;
  int factorisations = 0;
  double seconds_of_a_factor = 0.0;  ///< by the library that the reference solution factors with
};
[[nodiscard]] final_states time_final_states(const contct::problem& p, const contct::linear_structure& s);

/// Seconds of one dpbtrs with the factor of the structure as it starts: the cost of a plain solve.
[[nodiscard]] double seconds_of_a_solve(const contct::linear_structure& s);

/// The difference of two runs over their common events.
struct difference {
  bool same_events = true;  ///< ties within rounding may come in any order
  double load = 0.0;        ///< the largest of an event's load
  double displacement =
      0.0;  ///< the largest of D, relative to the largest D; not set unless both reached the same end
};
[[nodiscard]] difference difference_of(const run_of_engine& reference, const run_of_engine& other);

/// Least seconds of a call in which nothing happens, so that every pair is looked at and none is toggled. The
/// listing writes a line even then: `fortran` has the cost of a call without pairs, which is that line,
/// subtracted. The least of `rounds` rounds is taken.
struct seconds_of_a_call {
  double fortran;
  double cpp;
  double text;  ///< the listing's call without pairs
};
[[nodiscard]] seconds_of_a_call time_kernels(std::size_t pairs, int rounds);

/// Its result, compared with our certified state.
struct peer_answer {
  std::string method;
  double seconds = 0.0;    ///< of processor time, from K in memory to D; the median
  double mib = 0.0;        ///< the most memory that CHOLMOD had
  int steps = 0;           ///< of Newton's method
  double digits = 0.0;     ///< that all numbers are proved to have, at most 15
  int wrong_statuses = 0;  ///< of pairs
  int values = 0;          ///< compared
};

/// For a problem of one load step without settlements: Newton's method on K and the springs that press, a
/// factor updated by those that change, and a factor anew for each step. Nothing if CHOLMOD was not found.
/// Throws std::runtime_error if our own final state is not certified.
[[nodiscard]] std::vector<peer_answer> time_cholmod(const contct::problem& p,
                                                    const contct::linear_structure& s, int rounds);

}  // namespace bench
