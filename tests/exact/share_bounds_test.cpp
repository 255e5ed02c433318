// Proved distances of events from their shares of the load, against exact paths.
#include "contct/certify/share_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/read/problem_file.hpp"
#include "exact/random_comparison.hpp"

using namespace contct::app;
using namespace contct::certify;
namespace exact = contct::exact;
namespace lab = contct::lab;

namespace {

/// An increment with events, as it was told, and how far off it may be.
struct told_increment {
  int step;
  double fraction;
  std::vector<event> events;
  std::optional<double> bound;
};

/// Observes a path and bounds its shares, each `moved` from where it was told.
struct watch_shares final : observer {
  watch_shares(const problem& p, const linear_structure& s, double moved_by)
      : loads(loads_of(p, s)), ends(p, s), shares(s, loads, ends), moved(moved_by) {}

  void incremented(const increment& i) override {
    increment told = i;
    if (!i.events.empty()) told.fraction += moved;
    const std::optional<double> bound = shares.bound(told);
    if (!i.events.empty())
      all.push_back({i.step, told.fraction, {i.events.begin(), i.events.end()}, bound});
    else if (i.fraction == 1.0)
      CHECK(bound == 0.0);
  }

  load_history loads;
  error_prover ends;
  share_prover shares;
  double moved;
  std::vector<told_increment> all;
};

/// How far an event of an exact path is from where it was told: the nearest of its kind in that step.
double distance_of(const exact::exact_path& truly, const told_increment& told, const event& e) {
  double nearest = 2.0;
  for (const exact::exact_increment& i : truly.steps[told.step - 1].increments)
    for (const event& other : i.events)
      if (other.pair == e.pair && other.what == e.what)
        nearest =
            std::min(nearest, std::abs(exact::rounded(exact::binary_value(told.fraction) - i.fraction)));
  return nearest;
}

struct share_counts {
  int events = 0, proved = 0, close = 0;
};

void check_shares(const problem& p, double moved, share_counts& n) {
  const exact::exact_path truly = exact::follow_true_path(exact::exact_problem_of(p));
  const linear_structure s = structure_of(p);
  watch_shares watch(p, s, moved);
  (void)follow(p, s, "refactor", *make_kernel("corrected"), {&watch},
               {0, fallback_to_reference(s, loads_of(p, s)), nullptr});
  for (const told_increment& told : watch.all) {
    if (told.step > static_cast<int>(truly.steps.size())) continue;
    ++n.events;
    if (!told.bound) continue;
    ++n.proved;
    n.close += *told.bound < 1e-9 ? 1 : 0;
    for (const event& e : told.events) {
      CAPTURE(p.title, told.step, told.fraction, e.pair);
      CHECK(distance_of(truly, told, e) <= *told.bound);
    }
  }
}

}  // namespace

TEST_CASE("events happen within the distances that are proved, on exact paths of random problems") {
#ifdef CONTCT_HAS_GMP
  constexpr int problems = 16;
#else
  constexpr int problems = 4;  // Boost's own integers take minutes for a long one
#endif
  for (const double moved : {0.0, 1e-9, -1e-6, 1e-4}) {
    share_counts n;
    for (std::uint64_t number = 0; number < (moved == 0.0 ? problems : problems / 4); ++number)
      check_shares(lab::as_problem(lab::make_random_problem(23, number, {.most_elements = 5})), moved, n);
    CAPTURE(moved, n.events, n.proved, n.close);
    CHECK(n.events > (moved == 0.0 ? problems * 15 / 4 : problems * 3 / 4));
    CHECK(n.proved > n.events * 6 / 10);
    if (moved == 0.0) CHECK(n.close > n.events * 6 / 10);
    if (std::abs(moved) > 1e-9) CHECK(n.close == 0);
  }
}

TEST_CASE("the distance reaches from where the 1989 rule toggles a pair to where it makes") {
  const problem p = parse_problem(
      "[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.001\nstiffness = 1e5\n"
      "[[step]]\npoint = [ { node = 3, w = -24 } ]\n",
      "b.toml");
  const linear_structure s = structure_of(p);  // node 2 deflects by 5 P / 6 EI = 0.002: it makes at 1/2
  watch_shares watch(p, s, 0.0);
  const std::vector<event> makes = {{0, change::make}};
  const auto bound_at = [&](double share) {
    return watch.shares.bound({.step = 1, .number = 1, .s = share, .fraction = share, .events = makes});
  };
  REQUIRE(bound_at(0.5));
  CHECK(*bound_at(0.5) < 1e-13);
  REQUIRE(bound_at(0.497));
  CHECK(*bound_at(0.497) > 0.003);
  CHECK_FALSE(bound_at(0.25));
  const std::vector<event> breaks = {{0, change::break_}};
  CHECK_FALSE(
      watch.shares.bound({.step = 1, .number = 1, .s = 0.5, .fraction = 0.5, .events = breaks}).has_value());
}
