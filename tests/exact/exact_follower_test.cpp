// Paths that doubles lose are followed in rational numbers.
#include "contct/exact/exact_follower.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/exact/exact_residual.hpp"
#include "contct/exact/path.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::app;
namespace exact = contct::exact;

namespace {

struct kept_path final : observer {
  void incremented(const increment& i) override {
    if (!i.ahead.empty()) ahead.push_back({i.fraction, {i.events.begin(), i.events.end()}, i.snaps, {}});
    last_s = i.s;
  }
  void step_ended(const step_state& s) override {
    exactly.push_back(s.from_exact_path ? 1 : 0);
    lost.push_back(s.from_fallback ? 1 : 0);
    w.assign(s.displacement.begin(), s.displacement.end());
    isep.assign(s.isep.begin(), s.isep.end());
  }

  std::vector<followed_increment> ahead;  // that no kernel led to
  std::vector<char> exactly, lost;
  std::vector<double> w;
  std::vector<int> isep;
  double last_s = 0.0;
};

struct run {
  explicit run(const std::string& name, bool with_exact_path = true)
      : what(contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/" + name + ".toml")),
        structure(structure_of(what)),
        judged(what, structure, exact::exact_residual_of(what), exact::semidefinite_test_of(what)) {
    const auto leader = contct::outside::make_kernel("corrected");
    path_limits limits{0, judged.fallback(), judged.refiner(), nullptr};
    if (with_exact_path) limits.exactly = exact::exact_follower_of(what);
    end = follow(what, structure, "refactor", *leader, {&path, &judged}, limits);
  }

  problem what;
  linear_structure structure;
  certifier judged;
  kept_path path;
  path_end end;
};

}  // namespace

TEST_CASE("a drop onto stiff pairs is lost in doubles, and ends at its exact forces all the same") {
  const run r("dropped-onto-stiff-pairs");
  CHECK(r.end.status == path_status::solved);
  CHECK(r.path.exactly == std::vector<char>{0, 1});
  CHECK(r.path.lost == std::vector<char>{0, 0});
  CHECK(r.judged.all_exact());
  REQUIRE_FALSE(r.path.ahead.empty());
  CHECK(r.path.ahead.back().fraction == 1.0);
  CHECK(r.path.last_s == 1.0);
  CHECK(r.path.isep == std::vector<int>{in_contact, separated, separated, separated, in_contact});

  const run without("dropped-onto-stiff-pairs", false);
  CHECK(without.path.exactly == std::vector<char>{0, 0});
  CHECK(without.path.lost == std::vector<char>{0, 1});
}

TEST_CASE("a mesh that has no factor in doubles is followed from its first load on, make by make") {
  const run r("graded-mesh");
  CHECK(r.end.status == path_status::solved);
  CHECK(r.path.exactly.front() == 1);
  CHECK(r.judged.all_exact());

  const exact::exact_problem truly = exact::exact_problem_of(r.what);
  const exact::exact_path path = follow_true_path(truly);
  const auto step = exact::exact_follower_of(r.what)(2);
  REQUIRE(step);
  REQUIRE(step->increments.size() == 2);
  const exact::exact_increment& make = path.steps[1].increments[0];
  CHECK(step->increments[0].events == std::vector<event>{{1, change::make}});
  CHECK(step->increments[0].fraction == exact::rounded(make.fraction));
  CHECK(step->increments[0].d[1] == r.what.pairs[1].face);
  CHECK(step->increments[1].events.empty());
  CHECK(step->closed == path.steps[1].closed);
  for (std::size_t dof = 0; dof < step->displacement.size(); ++dof)
    CHECK(step->displacement[dof] == exact::rounded(path.steps[1].displacement[dof]));
}

TEST_CASE(
    "what only rounding could tell from a mechanism is followed to its end, and a mechanism to its share") {
  CHECK(run("held-by-a-hair").end.status == path_status::solved);
  problem p = contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/held-by-a-hair.toml");
  p.steps[0].points[1].value = -4e-17;  // it tips the other way
  p.steps[0].points[0].value = 0.032;
  const auto step = exact::exact_follower_of(p)(1);
  REQUIRE(step);
  CHECK(step->status == path_status::mechanism);
  CHECK(step->fraction == 0.0);
}

TEST_CASE("no step behind the end of an exact path is known, nor any of a problem that is too large") {
  const problem p = contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/graded-mesh.toml");
  CHECK_FALSE(exact::exact_follower_of(p)(3));

  problem large = p;
  beam long_beam;
  for (int i = 0; i <= exact::most_dofs_beside_doubles / 2; ++i) long_beam.x.push_back(i);
  long_beam.EI.assign(long_beam.x.size() - 1, 1.0);
  large.geometry.kind = long_beam;
  CHECK_FALSE(exact::exact_follower_of(large)(1));
  CHECK_FALSE(exact::small_exact_problem_of(large));
}
