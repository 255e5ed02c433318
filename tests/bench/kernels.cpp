#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <vector>

#include "bench/bench.hpp"
#include "contct/kernel/contct.h"
#include "contct/kernel/contct.hpp"
#include "contct/number/random.hpp"

namespace bench {
namespace {

/// Pairs of every kind without an event: moving away, too far away, without response, and pressed on the
/// face.
struct quiet_pairs {
  explicit quiet_pairs(std::size_t n)
      : dd(2 * n), dtest(2 * n), cc(n), ss(n), id(n), isep(n), isurf(n), events(n) {
    contct::random_numbers random(1989);
    for (std::size_t i = 0; i < n; ++i) {
      id[i] = static_cast<int>(i) + 1;
      isurf[i] = random.chance(0.5) ? contct::face_above : contct::face_below;
      const double gap = 0.5 + 0.5 * random.unit();
      const int kind = random.whole(0, 9);
      const bool closed = kind == 0;
      isep[i] = closed ? contct::in_contact : contct::separated;
      cc[i] = isurf[i] * gap;
      dd[2 * i] = closed ? cc[i] : 0.0;
      dtest[2 * i] = kind == 1 ? 0.0 : isurf[i] * (closed || random.chance(0.5) ? 0.25 : -0.25) * gap;
    }
  }

  std::vector<double> dd, dtest, cc, ss;
  std::vector<int> id, isep, isurf;
  std::vector<contct::event> events;
};

template <class Call>
double seconds_of(Call call, int repeats) {
  const auto start = cpu_clock::now();
  for (int k = 0; k < repeats; ++k) call();
  return std::chrono::duration<double>(cpu_clock::now() - start).count() / repeats;
}

}  // namespace

seconds_of_a_call time_kernels(std::size_t pairs, int rounds) {
  quiet_pairs q(pairs);
  const int repeats = static_cast<int>(std::max<std::size_t>(4'000'000 / pairs, 3));
  double smin = 0.0;
  const auto fortran = [&] {
    contct_call_r8(q.dd.data(), q.dtest.data(), q.cc.data(), q.ss.data(), &smin, q.id.data(), q.isep.data(),
                   q.isurf.data(), static_cast<int>(pairs), 1, 2);
    if (smin != 1.0) throw std::logic_error("a pair that was to be quiet has an event");
  };
  const auto text = [&] {
    contct_call_r8(q.dd.data(), q.dtest.data(), q.cc.data(), q.ss.data(), &smin, q.id.data(), q.isep.data(),
                   q.isurf.data(), 0, 1, 2);
  };
  const auto cpp = [&] {
    contct::call<double> c{q.dd, q.dtest, q.cc, q.ss, 0.0, q.id, q.isep, q.isurf, {1, 2}};
    if (contct::contct(c, q.events) != 0) throw std::logic_error("a pair that was to be quiet has an event");
  };
  constexpr double never = std::numeric_limits<double>::infinity();
  seconds_of_a_call least{never, never, never};
  for (int round = 0; round < rounds; ++round) {
    least.fortran = std::min(least.fortran, seconds_of(fortran, repeats));
    least.text = std::min(least.text, seconds_of(text, 1000));
    least.cpp = std::min(least.cpp, seconds_of(cpp, repeats));
  }
  least.fortran -= least.text;
  return least;
}

}  // namespace bench
