// The atlas counts what it says it counts, the same every time, and sees what is known to be there; the
// copies of the listing with another EPSMUL differ from it in that alone.
#include "contct/lab/atlas.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "contct/numeric/bits.hpp"
#include "contct/numeric/random.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;

namespace {

atlas_cell filled(atlas_cell c, int problems, std::uint64_t seed = 1) {
  fill(c, {problems, seed});
  return c;
}

atlas_cell with(const std::vector<problem_result>& trials) {
  atlas_cell c;
  for (const problem_result& t : trials) c.add(t);
  return c;
}

problem_result came_to(verdict v, double length_error, int uncertified) {
  problem_result t;
  t.came_to = v;
  t.length_error = length_error;
  t.displacement_error = length_error / 2;
  t.uncertified = uncertified;
  return t;
}

/// The answer to one call with a pair at each node: s, s_min and the statuses after it.
struct answer {
  std::vector<double> ss;
  double smin = 0.0;
  std::vector<int> isep;

  bool operator==(const answer& other) const {
    return isep == other.isep && same_bits(smin, other.smin) &&
           std::equal(ss.begin(), ss.end(), other.ss.begin(), same_bits<double>);
  }
};

/// One call of pairs below that are separated or in contact, D = 0, one dof a node.
answer ask(kernel& k, const std::vector<double>& d_star, const std::vector<double>& c,
           const std::vector<int>& isep) {
  const std::vector<double> d(c.size(), 0.0);
  const std::vector<int> below(c.size(), face_below);
  std::vector<int> id(c.size());
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<int>(i) + 1;
  answer a{std::vector<double>(c.size()), 0.0, isep};
  call<double> asked{d, d_star, c, a.ss, 0.0, id, a.isep, below, {}};
  k.answer(asked);
  a.smin = asked.smin;
  return a;
}

/// Two separated pairs whose scale factors are 0.5 and 0.5 (1 + apart): how many make contact?
long made(kernel& k, double apart) {
  const answer a = ask(k, {-1.0, -1.0}, {-0.5, -0.5 * (1 + apart)}, {separated, separated});
  return std::count(a.isep.begin(), a.isep.end(), in_contact);
}

}  // namespace

TEST_CASE("an answer off by 1e-3 is not yet wrong, one off by more is, and so is a false equilibrium") {
  CHECK(with({came_to(verdict::certified, 0.0, 0)}).wrong == 0);
  CHECK(with({came_to(verdict::wrong, 1e-3, 1)}).wrong == 0);
  CHECK(with({came_to(verdict::wrong, 1.1e-3, 1)}).wrong == 1);
  problem_result invented = came_to(verdict::wrong, 0.0, 1);
  invented.unfounded = 1;
  CHECK(with({invented}).wrong == 1);
  CHECK(with({invented}).false_equilibrium == 1);
  // A mechanism that really is one, after a step that was off: the step is what counts.
  CHECK(with({came_to(verdict::no_equilibrium, 0.0, 0)}).wrong == 0);
  CHECK(with({came_to(verdict::no_equilibrium, 0.2, 1)}).wrong == 1);
}

TEST_CASE("a path that stops says so: it is not wrong, but neither is it right") {
  problem_result at_start = came_to(verdict::false_mechanism, 0.0, 0);
  problem_result later = at_start;
  later.increments = 3;
  const atlas_cell c = with({at_start, later, came_to(verdict::no_end, 0.0, 0)});
  CHECK(c.wrong == 0);
  CHECK(c.false_mechanism == 2);
  CHECK(c.never_held == 1);
  CHECK(c.no_end == 1);
  CHECK(c.uncertified == 3);
}

TEST_CASE("what is wrong is uncertified too, and the errors are its own") {
  const atlas_cell c = with({came_to(verdict::wrong, 0.5, 1), came_to(verdict::wrong, 1e-5, 1),
                             came_to(verdict::wrong, 2e-3, 2), came_to(verdict::false_mechanism, 0.0, 0),
                             came_to(verdict::certified, 1e-12, 0), came_to(verdict::wrong, 0.1, 1),
                             came_to(verdict::no_end, 0.0, 0)});
  CHECK(c.problems == 7);
  CHECK(c.wrong == 3);
  CHECK(c.uncertified == 6);
  CHECK(c.errors == std::vector<double>{1e-3, 0.05, 0.25});  // of deflections
  CHECK(c.median_error() == 0.05);
  CHECK(c.worst_error() == 0.25);
  CHECK(atlas_cell{}.median_error() == 0.0);
}

TEST_CASE("Wilson's interval has the published values, and a width at 0 and at all") {
  // R. G. Newcombe, Statistics in Medicine 17 (1998) 857, table I, method 3.
  const struct {
    int hits, tried;
    double least, most;
  } known[] = {
      {81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0.0, 0.1611}, {1, 29, 0.0061, 0.1718}};
  for (const auto& k : known) {
    INFO(k.hits << " of " << k.tried);
    CHECK(std::abs(wilson(k.hits, k.tried).least - k.least) < 5e-5);
    CHECK(std::abs(wilson(k.hits, k.tried).most - k.most) < 5e-5);
  }
  CHECK(wilson(0, 20).least == 0.0);
  CHECK(wilson(20, 20).most == 1.0);
  CHECK(std::abs(wilson(20, 20).least - (1 - 0.1611)) < 5e-5);
}

TEST_CASE("the cells cover every unit, every EPSMUL and both precisions, held and free, once") {
  const std::vector<atlas_cell> cells = atlas_cells();
  CHECK(cells.size() == 106);  // 2 (13 * 3 + 2 * 7)
  for (const bool held : {true, false}) {
    const auto count = [&](auto wanted) {
      return std::count_if(cells.begin(), cells.end(),
                           [&](const atlas_cell& c) { return c.held == held && wanted(c); });
    };
    for (int decade = -12; decade <= 12; decade += 2) {
      for (const char* name : {"fortran", "fortran-r4", "corrected"}) {
        INFO(name << " at 1e" << decade);
        CHECK(count([&](const atlas_cell& c) {
                return c.kernel == name && std::abs(std::log10(c.unit) - decade) < 1e-9 &&
                       !c.has_other_epsmul();
              }) == 1);
      }
    }
    for (const double epsmul : epsmul_of_variants()) {
      for (const double unit : epsmul_units)
        CHECK(count([&](const atlas_cell& c) { return c.epsmul == epsmul && c.unit == unit; }) == 1);
    }
  }
}

TEST_CASE("the same seed gives the same counts, another seed others") {
  const atlas_cell asked{"fortran", printed_epsmul, 1e-4, true};
  const atlas_cell first = filled(asked, 60);
  const atlas_cell again = filled(asked, 60);
  CHECK(first.problems == 60);
  CHECK(first.wrong == again.wrong);
  CHECK(first.uncertified == again.uncertified);
  CHECK(first.errors == again.errors);
  CHECK(filled(asked, 60, 2).errors != first.errors);
}

TEST_CASE("more problems keep the first ones, and every one tried is told") {
  const atlas_cell asked{"fortran-r4", printed_epsmul, 1e-6, false};
  const atlas_cell few = filled(asked, 20);
  std::vector<atlas_cell> cells = {asked, filled(asked, 0)};
  std::int64_t told = 0;
  fill(cells, {40, 1}, 2, [&told](std::int64_t tried) { told += tried; });
  CHECK(told == 80);
  const atlas_cell& more = cells[0];
  CHECK(cells[1].errors == more.errors);
  CHECK(more.problems == 40);
  CHECK(more.wrong >= few.wrong);
  CHECK(std::includes(more.errors.begin(), more.errors.end(), few.errors.begin(), few.errors.end()));
}

TEST_CASE("the corrected kernel is certified in every cell of the atlas") {
  int problems = 0;
  for (const atlas_cell& c : atlas_cells()) {
    if (c.kernel != "corrected") continue;
    const atlas_cell f = filled(c, 40);
    INFO("unit " << c.unit << (c.held ? ", held" : ", free"));
    CHECK(f.wrong == 0);
    CHECK(f.uncertified == 0);
    problems += f.problems;
  }
  CHECK(problems == 2 * 13 * 40);
}

TEST_CASE(
    "the listing goes wrong in small units nearly always, at unit 1 seldom, and single precision oftener") {
  constexpr int problems = 120;
  const auto wrong = [](const char* name, double unit) {
    return filled({name, printed_epsmul, unit, true}, problems);
  };
  const atlas_cell small = wrong("fortran", 1e-12);
  const atlas_cell one = wrong("fortran", 1.0);
  const atlas_cell single = wrong("fortran-r4", 1.0);
  CHECK(small.wrong > 0.8 * problems);
  CHECK(small.median_error() > 0.1);
  CHECK(one.wrong > 0);
  CHECK(one.wrong < 0.15 * problems);
  CHECK(one.uncertified > one.wrong);
  CHECK(one.uncertified < 0.25 * problems);
  CHECK(single.wrong > one.wrong);
  CHECK(single.uncertified > 0.4 * problems);  // rounding to 4 bytes alone
}

TEST_CASE("free structures in small units: mechanisms that are none, and equilibria that are none") {
  const atlas_cell c = filled({"fortran", printed_epsmul, 1e-12, false}, 120);
  CHECK(c.false_mechanism > 20);
  CHECK(c.never_held > 0);
  CHECK(c.never_held < c.false_mechanism);
  CHECK(c.false_equilibrium > 0);
  CHECK(c.false_equilibrium <= c.wrong);
  CHECK(c.wrong + c.false_mechanism + c.no_end >= c.problems / 2);
  CHECK(c.uncertified <= c.problems);
}

TEST_CASE("with a small EPSMUL the listing is wrong less often, and hardly ever where EPSGAP does no harm") {
  const auto wrong = [](double epsmul, double unit) {
    return filled({"fortran", epsmul, unit, true}, 300).wrong;
  };
  CHECK(wrong(1e-9, 1.0) < 0.8 * wrong(printed_epsmul, 1.0));
  CHECK(wrong(printed_epsmul, 100.0) > 6);
  CHECK(wrong(1e-9, 100.0) <= 2);
}

TEST_CASE("a cell of an EPSMUL that no copy has is refused") {
  CHECK_THROWS_AS(filled({"fortran", 3e-5, 1.0, true}, 1), std::invalid_argument);
}

TEST_CASE("EPSMUL of the variants falls from below the printed one to 1e-12") {
  const std::vector<double> values = epsmul_of_variants();
  REQUIRE(values.size() == 7);
  CHECK(values.front() == 1e-3);
  CHECK(values.back() == 1e-12);
  CHECK(std::is_sorted(values.rbegin(), values.rend()));
  CHECK(printed_epsmul == 1.0 / 256);
}

TEST_CASE("without near ties every variant answers as the listing does, to the bit") {
  const auto listing = make_kernel("fortran");
  random_numbers random(11);
  int events = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<double> d_star, c;
    std::vector<int> isep;
    for (int pair = 0; pair < 6; ++pair) {
      // Scale factors are at least 1/40 apart: s = 0.1 + 0.15 (pair + 0..0.8), one pair at its face now and
      // then.
      const double s = 0.1 + 0.15 * (pair + 0.8 * random.unit());
      d_star.push_back(random.unit() < 0.5 ? -1.0 - random.unit() : 1.0 + random.unit());
      c.push_back(random.chance(0.05) ? 0.0 : s * d_star.back());
      isep.push_back(random.chance(0.5) ? separated : in_contact);
    }
    const answer expected = ask(*listing, d_star, c, isep);
    events += expected.isep != isep ? 1 : 0;
    for (std::size_t variant = 0; variant < epsmul_of_variants().size(); ++variant) {
      INFO("round " << round << ", EPSMUL " << epsmul_of_variants()[variant]);
      CHECK(ask(*make_epsmul_variant(variant), d_star, c, isep) == expected);
    }
  }
  CHECK(events > 400);
}

TEST_CASE("a tie within 2^-8 and outside 1e-3 parts the listing from its variants") {
  constexpr double apart = 2e-3;
  CHECK(made(*make_kernel("fortran"), apart) == 2);
  for (std::size_t variant = 0; variant < epsmul_of_variants().size(); ++variant)
    CHECK(made(*make_epsmul_variant(variant), apart) == 1);
}

TEST_CASE("each variant takes along what is within its own EPSMUL, and no more") {
  const std::vector<double> values = epsmul_of_variants();
  for (std::size_t variant = 0; variant < values.size(); ++variant) {
    INFO("EPSMUL " << values[variant]);
    const auto k = make_epsmul_variant(variant);
    CHECK(made(*k, 0.9 * values[variant]) == 2);
    CHECK(made(*k, 1.1 * values[variant]) == 1);
  }
  CHECK(made(*make_kernel("fortran"), 0.9 * printed_epsmul) == 2);
  CHECK(made(*make_kernel("fortran"), 1.1 * printed_epsmul) == 1);
}

TEST_CASE("no variant is a kernel that can be chosen") {
  for (const std::string& name : kernel_names()) CHECK(name.find("EPSMUL") == std::string::npos);
  CHECK_THROWS_AS(make_kernel(make_epsmul_variant(0)->facts().name), std::invalid_argument);
  CHECK(make_epsmul_variant(4)->facts().name == "fortran with EPSMUL 1e-09");
}
