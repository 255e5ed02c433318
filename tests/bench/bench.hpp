// The timed work of the benchmark. Results are rows in JSON, whose keys reference/speed.md explains.
#pragma once

#include <ctime>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "contct/structure/problem.hpp"
#include "contct/structure/structure.hpp"

namespace bench {

using json = nlohmann::ordered_json;

/// Returns this thread's processor time in seconds, which is correct on a busy machine too.
inline double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Call>
double seconds_of(Call call) {
  const double start = now();
  call();
  return now() - start;
}

inline constexpr double long_enough = 20.0;  ///< seconds; a longer run is not repeated

/// Returns the problem file of a family and size, such as "rail-50". Throws std::invalid_argument for an
/// unknown name.
[[nodiscard]] std::string text_of(const std::string& name);

/// Times calls of FORTRAN and of the C++ kernel without an event: the least time of `rounds` rounds. FORTRAN
/// also writes a line of text; the time of a call without pairs, which only writes this line, is subtracted.
[[nodiscard]] json time_kernels(std::size_t pairs, int rounds);

/// Times CHOLMOD without an engine, from K in memory to D, on the whole path with an updated factor and, for
/// a problem of one load step, by Newton's method on K and the springs of pressed pairs, once with an updated
/// factor and once with a new factor for each step. Compares the results with our certified state. The
/// problem must have no settlement, and each step goes on from the last. Returns nothing without CHOLMOD.
/// Throws std::runtime_error if our own final state is not certified. `only`: the method; empty: all.
[[nodiscard]] std::vector<json> time_cholmod(const contct::problem& p, const contct::linear_structure& s,
                                             int rounds, const std::string& only);

}  // namespace bench
