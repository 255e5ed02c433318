// Thousands of random problems: every state that the corrected rule ends in is right, and what must not
// matter does not. The floors keep a check from passing because there was nothing to check.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "catch.hpp"
#include "check/followed.hpp"

using namespace contct;

namespace {

/// What a campaign came across.
struct tally {
  long makes = 0, breaks = 0, standstills = 0, snaps = 0, rescued = 0, steps = 0, unique = 0, mechanisms = 0;
  int most_increments = 0;
  std::map<std::string_view, int> layouts;

  void count(const random_problem& p, const followed& f) {
    for (const auto& i : f.seen.increments) {
      for (const event& e : i.events) ++(e.what == change::make ? makes : breaks);
      standstills += i.s == 0.0 ? 1 : 0;
      snaps += i.snaps ? 1 : 0;
      most_increments = std::max(most_increments, i.number);
    }
    for (const auto& step : f.seen.steps) rescued += step.rescued ? 1 : 0;
    for (const auto& c : f.certificates) {
      steps += c ? 1 : 0;
      unique += c && c->unique ? 1 : 0;
    }
    mechanisms += f.end.status == path_status::mechanism ? 1 : 0;
    ++layouts[name_of(p.layout)];
  }
};

std::ostream& operator<<(std::ostream& out, const tally& t) {
  return out << t.makes << " makes, " << t.breaks << " breaks, " << t.standstills << " standstills, "
             << t.snaps << " snaps, " << t.rescued << " rescued, " << t.steps << " steps, " << t.unique
             << " unique, " << t.mechanisms << " mechanisms, at most " << t.most_increments << " increments";
}

random_problem_kind only(double free_share) {
  random_problem_kind kind;
  kind.free_share = free_share;
  return kind;
}

}  // namespace

TEST_CASE("campaign: held by supports, every step of 3000 problems ends in a certified state") {
  tally t;
  for (std::uint64_t number = 0; number < 3000; ++number) {
    const random_problem p = make_random_problem(1, number, only(0.0));
    const followed f = follow(p, "corrected", false);
    INFO(number << " " << name_of(p.layout) << ", unit " << p.unit);
    CHECK(f.solved());
    CHECK(f.certificates.size() == p.steps.size());
    for (const auto& c : f.certificates) {
      REQUIRE(c.has_value());
      INFO(c->problem);
      CHECK(c->exact);
      CHECK(c->unique);
    }
    t.count(p, f);
  }
  INFO(t);
  CHECK(t.steps > 7000);
  CHECK(t.makes > 8000);
  CHECK(t.breaks > 8000);
  CHECK(t.standstills > 3000);
  CHECK(t.layouts.size() == face_layouts);
  for (const auto& [layout, times] : t.layouts) CHECK(times > 250);
  CHECK(t.most_increments < 1000);
}

TEST_CASE(
    "campaign: held by pairs alone, 1000 problems end certified, or as mechanisms that the oracle confirms") {
  tally t;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    const random_problem p = make_random_problem(2, number, only(1.0));
    const followed f = follow(p);
    INFO(number << " " << name_of(p.layout) << ", unit " << p.unit);
    if (f.solved()) {
      CHECK(f.certificates.size() == p.steps.size());
    } else {
      CHECK(f.end.status == path_status::mechanism);
      CHECK_FALSE(f.last_has_equilibrium);
    }
    for (const auto& c : f.certificates) {
      if (!c) continue;
      INFO(c->problem);
      CHECK(c->exact);
    }
    t.count(p, f);
  }
  INFO(t);
  CHECK(t.steps > 1500);
  CHECK(t.unique > 1000);
  CHECK(t.makes > 4000);
  CHECK(t.breaks > 2000);
  CHECK(t.standstills > 1000);
  CHECK(t.snaps > 200);
  CHECK(t.mechanisms > 200);
  CHECK(t.rescued < 10);
}

TEST_CASE("campaign: the listing's rule is not certified as often, the certificate can tell") {
  int wrong = 0;
  int right = 0;
  for (std::uint64_t number = 0; number < 500; ++number) {
    random_problem_kind kind = only(0.0);
    kind.least_unit = kind.most_unit = 1.0;
    const followed f = follow(make_random_problem(3, number, kind), "cpp");
    ++(f.all_exact() ? right : wrong);
  }
  INFO(wrong << " of " << wrong + right << " are wrong");
  CHECK(wrong > 20);
  CHECK(right > 250);
}

namespace {

/// Do the last states agree, within what both were certified to? Deflections are compared.
void check_agreement(const followed& a, const followed& b, const std::function<double(std::size_t)>& of_b) {
  double off = 0.0;
  for (std::size_t dof = 0; dof < a.last().size(); dof += 2)
    off = std::max(off, std::abs(a.last()[dof] - of_b(dof)));
  const double size = std::max(largest_deflection(a), largest_deflection(b));
  CHECK(off <= (last_tolerance(a) + last_tolerance(b)) * size);
}

load times(double factor, load l) {
  for (point_load& p : l.points) p.value *= factor;
  for (distributed_load& d : l.distributed) {
    for (double& a : d.polynomial) a *= factor;
  }
  return l;
}

/// All loads and faces `factor` times as large.
random_problem scaled(double factor, random_problem p) {
  for (load& l : p.steps) l = times(factor, l);
  for (contact_pair& c : p.pairs) c.face *= factor;
  return p;
}

random_problem upside_down(random_problem p) {
  for (load& l : p.steps) l = times(-1.0, l);
  for (contact_pair& c : p.pairs) {
    c.face = -c.face;
    c.surface = -c.surface;
  }
  return p;
}

/// Left and right exchanged. All distributed loads are even, and on the whole beam.
random_problem other_way_round(random_problem p) {
  const int last = p.geometry.nodes() - 1;
  const double end = p.geometry.x.back();
  for (double& x : p.geometry.x) x = end - x;
  std::reverse(p.geometry.x.begin(), p.geometry.x.end());
  std::reverse(p.geometry.EI.begin(), p.geometry.EI.end());
  for (support& s : p.supports) s.node = last - s.node;
  for (contact_pair& c : p.pairs) c.node = last - c.node;
  for (load& l : p.steps) {
    for (point_load& f : l.points) f = {last - f.node, f.dof, f.dof == 1 ? -f.value : f.value};
  }
  return p;
}

}  // namespace

TEST_CASE("campaign: in many steps or in one, the last state is the same") {
  int compared = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    random_problem p = make_random_problem(4, number);
    if (p.steps.size() == 1) continue;
    const followed many = follow(p);
    if (!many.solved() || !many.certificates.back()->unique) continue;
    p.steps = {p.steps.back()};
    const followed one = follow(p);
    INFO(number);
    REQUIRE(one.solved());
    check_agreement(many, one, [&](std::size_t dof) { return one.last()[dof]; });
    ++compared;
  }
  CHECK(compared > 500);
}

TEST_CASE("campaign: loaded and unloaded to nothing, a held structure stands where it began") {
  int loaded = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    random_problem p = make_random_problem(5, number, only(0.0));
    p.steps.emplace_back();
    const followed f = follow(p);
    INFO(number);
    REQUIRE(f.solved());
    const double largest = largest_deflection(f);
    loaded += largest > 0.0 ? 1 : 0;
    for (std::size_t dof = 0; dof < f.last().size(); dof += 2)
      CHECK(std::abs(f.last()[dof]) <= last_tolerance(f) * largest);
  }
  CHECK(loaded > 900);  // the others have all their load on a support
}

TEST_CASE("campaign: loads and faces 2^30 times as large give 2^30 times the deflections, to the bit") {
  const double factor = std::ldexp(1.0, 30);
  long events = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    const random_problem p = make_random_problem(6, number);
    const followed here = follow(p, "corrected", false);
    const followed there = follow(scaled(factor, p), "corrected", false);
    INFO(number);
    CHECK(there.end.status == here.end.status);
    CHECK(there.seen.events() == here.seen.events());
    REQUIRE(there.seen.steps.size() == here.seen.steps.size());
    for (std::size_t step = 0; step < here.seen.steps.size(); ++step) {
      std::vector<double> expected = here.seen.steps[step].u;
      for (double& x : expected) x *= factor;
      CHECK(there.seen.steps[step].u == expected);
    }
    events += static_cast<long>(here.seen.events().size());
  }
  CHECK(events > 5000);
}

TEST_CASE("campaign: loads and faces 0.37 times as large give 0.37 times the deflections") {
  int compared = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    const random_problem p = make_random_problem(7, number);
    const followed here = follow(p);
    const followed there = follow(scaled(0.37, p));
    INFO(number);
    CHECK(there.end.status == here.end.status);
    if (!here.solved() || !here.certificates.back()->unique) continue;
    const followed& small = there;
    double off = 0.0;
    for (std::size_t dof = 0; dof < here.last().size(); dof += 2)
      off = std::max(off, std::abs(small.last()[dof] - 0.37 * here.last()[dof]));
    CHECK(off <= 2 * last_tolerance(here) * 0.37 * largest_deflection(here));
    ++compared;
  }
  CHECK(compared > 800);
}

TEST_CASE("campaign: upside down, everything is the same to the bit with the other sign") {
  long events = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    const random_problem p = make_random_problem(8, number);
    const followed here = follow(p, "corrected", false);
    const followed there = follow(upside_down(p), "corrected", false);
    INFO(number);
    CHECK(there.end.status == here.end.status);
    CHECK(there.seen.events() == here.seen.events());
    REQUIRE(there.seen.steps.size() == here.seen.steps.size());
    for (std::size_t step = 0; step < here.seen.steps.size(); ++step) {
      std::vector<double> expected = here.seen.steps[step].u;
      for (double& x : expected) x = -x;
      CHECK(there.seen.steps[step].u == expected);
    }
    events += static_cast<long>(here.seen.events().size());
  }
  CHECK(events > 5000);
}

TEST_CASE("campaign: with left and right exchanged, so are the deflections") {
  int compared = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    const random_problem p = make_random_problem(9, number);
    const followed here = follow(p);
    const followed there = follow(other_way_round(p));
    INFO(number);
    CHECK(there.end.status == here.end.status);
    if (!here.solved() || !here.certificates.back()->unique) continue;
    const std::size_t last = here.last().size() - 2;
    check_agreement(here, there, [&](std::size_t dof) { return there.last()[last - dof]; });
    ++compared;
  }
  CHECK(compared > 800);
}
