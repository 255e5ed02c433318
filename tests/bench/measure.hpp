// One engine on one problem, timed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/path/observer.hpp"
#include "contct/solve/engine.hpp"

namespace bench {

/// An event and the share of the load at which it came: steps already done plus the share of the one under
/// way.
struct timed_event {
  int pair;
  double load;
};

/// What one run of one engine gave.
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

/// Follow the path under the corrected rule. `most_events` in a step, 0: all. The certificate is asked for
/// where `certify` says so and the path is whole; its time is measured by itself.
[[nodiscard]] run_of_engine run_engine(const contct::problem& p, const contct::linear_structure& s,
                                       const std::string& engine, int most_events, bool certify);

/// The ends of all steps without a path, and without a certificate.
struct final_states {
  double seconds = 0.0;
  int factorisations = 0;
  double seconds_of_a_factor = 0.0;  ///< by the library that the reference solution factors with
};
[[nodiscard]] final_states time_final_states(const contct::problem& p, const contct::linear_structure& s);

/// Entries of the factor by which an engine solves; nothing where it has none of the whole stiffness, or does
/// not tell.
[[nodiscard]] std::optional<double> entries_of_factor(const contct::linear_structure& s,
                                                      const std::string& engine);

/// Seconds of one dpbtrs with the factor of the structure as it starts: what a plain solve costs.
[[nodiscard]] double seconds_of_a_solve(const contct::linear_structure& s);

/// How two runs differ over the events that both have.
struct difference {
  bool same_events = true;  ///< ties within rounding may come in any order
  double load = 0.0;        ///< the largest of an event's load
  double displacement =
      0.0;  ///< the largest of D, relative to the largest D; nothing unless both went as far
};
[[nodiscard]] difference difference_of(const run_of_engine& reference, const run_of_engine& other);

}  // namespace bench
