// What a fuzz run on calls costs, against the FORTRAN calls alone with unit 26 on the null device: both in
// one process, in turns, the least of several rounds. Prints times and the ratio; it is no test.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

#include "contct/kernel/fortran.hpp"
#include "contct/lab/fuzz.hpp"
#include "contct/lab/random_calls.hpp"

namespace {

constexpr std::uint64_t calls = 100'000;
constexpr std::uint64_t seed = 1989;
constexpr int rounds = 7;

template <class Work>
double seconds_of(Work work) {
  const auto started = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

}  // namespace

int main() {
  const double never = std::numeric_limits<double>::infinity();
  double making = never;
  double fortran = never;
  double lockstep = never;
  double read = 0.0;  // so that nothing is optimised away
  for (int round = 0; round < rounds; ++round) {
    contct::app::call_outputs out;
    making = std::min(making, seconds_of([&] {
                        contct::app::call_source source(seed, 8);
                        for (std::uint64_t n = 1; n <= calls; ++n) read += out.prepare(source.at(n)).smin;
                      }));
    fortran = std::min(fortran, seconds_of([&] {
                         contct::app::call_source source(seed, 8);
                         for (std::uint64_t n = 1; n <= calls; ++n) {
                           contct::app::call<double> c = out.prepare(source.at(n));
                           contct::kernels::fortran::contct(c);
                           read += c.smin;
                         }
                       }));
    lockstep = std::min(lockstep, seconds_of([&] {
                          read += static_cast<double>(
                              contct::app::run_fuzz({{"fortran", "cpp"}, calls, 0, seed}).result.calls);
                        }));
  }
  std::printf("%llu calls: making them %.0f ms; FORTRAN alone %.0f ms; in lockstep, all in all, %.0f ms\n",
              static_cast<unsigned long long>(calls), 1e3 * making, 1e3 * (fortran - making), 1e3 * lockstep);
  std::printf("lockstep / FORTRAN alone: %.2f (allowed: 3); with the making of calls in both: %.2f\n",
              lockstep / (fortran - making), lockstep / fortran);
  return read > 0.0 ? 0 : 1;
}
