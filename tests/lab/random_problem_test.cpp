// Tests that random problems have their declared properties, and that their paths are solved and certified.
// Minimum counts ensure that enough was checked.
#include "contct/lab/random_problem.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/kernel/call.hpp"
#include "contct/kernel/registry.hpp"
#include "support/tried_problem.hpp"

using namespace contct;

namespace {

constexpr std::uint64_t problems = 4000;

const beam* beam_of(const random_problem& p) {
  return std::get_if<beam>(&p.geometry.kind);
}

/// Returns most of a problem's numbers.
std::vector<double> numbers_of(const random_problem& p) {
  std::vector<double> all{p.unit, static_cast<double>(nodes(p.geometry))};
  for (const contact_pair& c : p.pairs) {
    const double parts[] = {static_cast<double>(c.node), static_cast<double>(c.surface), c.face, c.stiffness};
    all.insert(all.end(), std::begin(parts), std::end(parts));
  }
  for (const support& s : p.supports) all.push_back(s.node + 0.25 * s.dof + s.spring);
  for (const load& l : p.steps) {
    for (const point_load& f : l.points) all.push_back(f.value);
    for (const distributed_load& d : l.distributed) all.push_back(d.polynomial[0]);
  }
  return all;
}

bool is_nothing(const load& l) {
  return std::all_of(l.points.begin(), l.points.end(), [](const point_load& p) { return p.value == 0.0; }) &&
         std::all_of(l.distributed.begin(), l.distributed.end(),
                     [](const distributed_load& d) { return d.polynomial[0] == 0.0; });
}

}  // namespace

TEST_CASE("a random problem depends only on its seed and number, and 900 of these problems all differ") {
  std::set<std::vector<double>> seen;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (std::uint64_t number = 0; number < 300; ++number) {
      const std::vector<double> once = numbers_of(make_random_problem(seed, number));
      CHECK(once == numbers_of(make_random_problem(seed, number)));
      seen.insert(once);
    }
  }
  CHECK(seen.size() == 900);
}

TEST_CASE("three pinned random problems keep their sizes, faces and stiffnesses in every version") {
  // Faces are computed by a solve and units by pow(), so the last digits of faces and units are not compared.
  struct pinned {
    std::uint64_t seed, number;
    bool held;
    face_layout layout;
    int nodes;
    std::size_t supports, pairs, steps;
    double unit, last_face, last_stiffness;
  };
  const pinned known[] = {
      {1, 0, true, face_layout::mixed, 22, 2, 4, 1, 0.0227337944608467, 0, 2.251095155184},
      {1, 1, true, face_layout::gaps, 6, 2, 2, 5, 792067.46454214, -11560.1760943103, 9.93323884198174},
      {3, 12345, true, face_layout::near_ties, 23, 4, 20, 3, 1.68588277682789e-08, 3.2565940261966e-13,
       55822045918044.2},
  };
  for (const pinned& k : known) {
    const random_problem p = make_random_problem(k.seed, k.number);
    INFO(k.seed << ", " << k.number);
    CHECK(p.held == k.held);
    CHECK(p.layout == k.layout);
    CHECK(nodes(p.geometry) == k.nodes);
    CHECK(p.supports.size() == k.supports);
    CHECK(p.pairs.size() == k.pairs);
    CHECK(p.steps.size() == k.steps);
    CHECK(p.unit == Approx(k.unit).epsilon(1e-10));
    CHECK(p.pairs.back().face == Approx(k.last_face).epsilon(1e-6));
    CHECK(p.pairs.back().stiffness == Approx(k.last_stiffness).epsilon(1e-10));
  }
}

TEST_CASE("every random problem has valid supports, pairs and steps") {
  for (std::uint64_t number = 0; number < problems; ++number) {
    const random_problem p = make_random_problem(21, number);
    INFO(number << " " << name_of(p.layout));
    const int count = nodes(p.geometry);
    std::set<int> fixed;
    for (const support& s : p.supports) {
      CHECK((s.node >= 0 && s.node < count));
      CHECK(s.fixed == (s.spring == 0.0));
      if (s.fixed && s.dof == 0) fixed.insert(s.node);
    }
    CHECK(p.held == !p.supports.empty());
    REQUIRE_FALSE(p.pairs.empty());
    for (const contact_pair& c : p.pairs) {
      CHECK((c.node >= 0 && c.node < count));
      // If no other pair was drawn, there is a pair at the middle node, which may be fixed.
      CHECK((!fixed.contains(c.node) || c.node == count / 2));
      CHECK((c.surface == face_above || c.surface == face_below));
      CHECK(c.stiffness > 0.0);
      CHECK(c.surface * c.face >= 0.0);  // no face is inside the structure
      CHECK(c.closed == (c.face == 0.0));
    }
    CHECK((!p.steps.empty() && p.steps.size() <= 5));
    // An antisymmetric problem has no load in the middle, so its first step may be empty.
    CHECK((!is_nothing(p.steps[0]) || p.layout == face_layout::antisymmetric));
    for (const load& l : p.steps) {
      for (const point_load& f : l.points) {
        CHECK((f.node >= 0 && f.node < count));
        CHECK((f.dof >= 0 && f.dof < dofs_per_node(p.geometry)));
      }
    }
    if (const beam* b = beam_of(p)) {
      CHECK(std::is_sorted(b->x.begin(), b->x.end(), std::less_equal<>()));
      CHECK(b->x.back() == Approx(p.unit).epsilon(1e-12));
    }
  }
}

TEST_CASE(
    "2000 random structures with supports are certified at every step without the reference solution as "
    "fallback") {
  random_problem_kind kind;
  kind.free_share = 0.0;
  const auto k = make_kernel("corrected");
  path_counts counted;
  std::map<face_layout, int> layouts;
  std::size_t steps = 0;
  for (std::uint64_t number = 0; number < 2000; ++number) {
    const random_problem p = make_random_problem(1, number, kind);
    const problem_result t = try_and_count(p, *k, counted);
    INFO(number << ", " << name_of(p.layout) << ", unit " << p.unit);
    CHECK(t.came_to == verdict::certified);
    ++layouts[p.layout];
    steps += t.certificates.size();
  }
  CHECK(counted.fallbacks == 0);
  CHECK(counted.snaps == 0);
  CHECK(steps > 5000);
  CHECK(counted.makes > 6000);
  CHECK(counted.breaks > 6000);
  CHECK(counted.at_rest > 2000);
  CHECK(layouts.size() == face_layouts);
  for (const auto& [layout, times] : layouts) CHECK(times > 150);
}
