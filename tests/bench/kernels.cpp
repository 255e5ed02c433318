#include "bench/kernels.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <vector>

#include "bench/cpu_clock.hpp"
#include "contct/compare/compare.hpp"
#include "contct/kernel/contct.h"
#include "contct/kernel/contct.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/number/random.hpp"

namespace bench {
namespace {

/// Pairs of every kind that has no event ahead: receding, too far away, without response, at rest on the
/// face and pressed there.
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

/// One call in lockstep: the listing leads, C++ follows.
class both_kernels {
 public:
  explicit both_kernels(quiet_pairs& q) : q_(q), isep_before_(q.isep) {}

  /// SMIN, SS and ISEP of each call, and the text of a block of calls.
  void ask_in_block() {
    contct::call<double> c = asked_of_leader();
    (void)follows_.ask({c, isep_before_, {}, ++calls_});
    constexpr int block = 2048;
    if (calls_ % block != 0) return;
    (void)compare_text(leader_->take_text(), cpp_->take_text(), follows_.compared);
  }

  void ask_on_path() {
    contct::call<double> c = asked_of_leader();
    const std::string text = leader_->take_text();
    (void)follows_.ask({c, isep_before_, text, ++calls_});
  }

  /// Throws where they differ, or less was compared than SMIN, SS and ISEP of each call.
  void judge() const {
    const std::int64_t values = calls_ * (1 + 2 * std::ssize(q_.cc));
    if (follows_.compared.mismatches != 0 || follows_.compared.values < values)
      throw std::logic_error("the kernels differ, or are not compared");
  }

 private:
  contct::call<double> asked_of_leader() {
    contct::call<double> c{q_.dd, q_.dtest, q_.cc, q_.ss, 0.0, q_.id, q_.isep, q_.isurf, {1, 2}};
    leader_->answer(c);
    return c;
  }

  quiet_pairs& q_;
  std::vector<int> isep_before_;
  std::int64_t calls_ = 0;
  std::unique_ptr<contct::kernel> leader_ = contct::make_kernel("fortran");
  std::unique_ptr<contct::kernel> cpp_ = contct::make_kernel("cpp");
  contct::follower follows_{leader_->facts(), *cpp_};
};

void time_lockstep(quiet_pairs& q, int rounds, int repeats, seconds_of_a_call& least) {
  both_kernels in_blocks(q);
  for (int round = 0; round < rounds; ++round)
    least.lockstep = std::min(least.lockstep, seconds_of([&] { in_blocks.ask_in_block(); }, repeats));
  in_blocks.judge();
}

void time_lockstep_on_path(quiet_pairs& q, int rounds, int repeats, seconds_of_a_call& least) {
  both_kernels on_path(q);
  for (int round = 0; round < rounds; ++round)
    least.lockstep_on_path =
        std::min(least.lockstep_on_path, seconds_of([&] { on_path.ask_on_path(); }, repeats));
  on_path.judge();
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
  seconds_of_a_call least{never, never, never, never, never};
  for (int round = 0; round < rounds; ++round) {
    least.fortran = std::min(least.fortran, seconds_of(fortran, repeats));
    least.text = std::min(least.text, seconds_of(text, 1000));
    least.cpp = std::min(least.cpp, seconds_of(cpp, repeats));
  }
  least.fortran -= least.text;
  time_lockstep(q, rounds, std::max(repeats / 4, 3), least);
  time_lockstep_on_path(q, rounds, std::max(repeats / 4, 3), least);
  return least;
}

}  // namespace bench
