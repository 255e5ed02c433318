// Tests that results do not depend on the way to a load, on units of load and length, or on the orientation.
// Random problems are used, with minimum counts of comparisons.
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/results/random_problem.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

constexpr std::uint64_t problems = 300;

/// The observed path of a problem under the corrected rule.
struct followed : solved_path {
  recorder seen;
  std::size_t stride = 2;  // dofs of a node; the deflection is the first

  [[nodiscard]] bool solved() const { return end.status == path_status::solved; }
  /// Returns true if the path is solved and its final state is unique.
  [[nodiscard]] bool determined() const { return solved() && steps.back().judged->unique; }
  /// Returns the deflection of a node at the end of the last step.
  [[nodiscard]] double deflection(std::size_t node) const { return steps.back().displacement[node * stride]; }
  [[nodiscard]] std::size_t nodes() const { return steps.back().displacement.size() / stride; }
  /// Returns the largest deflection in any reported step.
  [[nodiscard]] double largest() const {
    double most = 0.0;
    for (const solved_step& step : steps)
      for (std::size_t dof = 0; dof < step.displacement.size(); dof += stride)
        most = std::max(most, std::abs(step.displacement[dof]));
    return most;
  }
};

/// Final states are proved if `proved`, and otherwise remain as the path reached them.
followed follow(const random_problem& p, bool proved = true) {
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  certifier proof(p, s);
  followed f;
  f.stride = static_cast<std::size_t>(s.dofs_per_node);
  static_cast<solved_path&>(f) =
      follow(p, s, "refactor", *make_kernel("corrected"), {&f.seen}, proved ? &proof : nullptr);
  return f;
}

/// Returns a problem with all loads and faces multiplied by `factor`, turned upside down if this is negative.
random_problem scaled(double factor, random_problem p) {
  for (load& l : p.steps) {
    for (point_load& f : l.points) f.value *= factor;
    for (distributed_load& d : l.distributed)
      for (double& a : d.polynomial) a *= factor;
  }
  for (contact_pair& c : p.pairs) {
    c.face *= factor;
    c.surface *= factor < 0 ? -1 : 1;
  }
  return p;
}

/// Returns a beam with left and right exchanged. Its distributed loads must be uniform on the whole beam.
random_problem other_way_round(random_problem p) {
  beam& b = std::get<beam>(p.geometry.kind);
  const int last = b.nodes() - 1;
  const double end = b.x.back();
  for (double& x : b.x) x = end - x;
  std::reverse(b.x.begin(), b.x.end());
  for (support& s : p.supports) s.node = last - s.node;
  for (contact_pair& c : p.pairs) c.node = last - c.node;
  for (load& l : p.steps) {
    for (point_load& f : l.points) f = {last - f.node, f.dof, f.dof == 1 ? -f.value : f.value};
  }
  return p;
}

/// Checks that the final deflections of `a` equal `expected` within the certified errors of both.
void check_deflections(const followed& a, const std::function<double(std::size_t)>& expected) {
  double off = 0.0;
  for (std::size_t node = 0; node < a.nodes(); ++node)
    off = std::max(off, std::abs(a.deflection(node) - expected(node)));
  CHECK(off <= 2 * certified_share * a.largest());
}

/// Checks that each problem and its `scaled` form have the same events, and displacements with the ratio
/// `factor` to the bit.
void check_same_path(std::uint64_t seed, double factor, const random_problem_kind& kind = {}) {
  long events = 0;
  for (std::uint64_t number = 0; number < problems; ++number) {
    const random_problem p = make_random_problem(seed, number, kind);
    const followed here = follow(p, false);  // without refinement, which uses decimals that do not scale
    const followed there = follow(scaled(factor, p), false);
    INFO(number);
    CHECK(there.end.status == here.end.status);
    CHECK(there.seen.events() == here.seen.events());
    REQUIRE(there.steps.size() == here.steps.size());
    for (std::size_t step = 0; step < here.steps.size(); ++step) {
      std::vector<double> expected = here.steps[step].displacement;
      for (double& x : expected) x *= factor;
      CHECK(there.steps[step].displacement == expected);
    }
    events += static_cast<long>(here.seen.events().size());
  }
  CHECK(events > 1500);
}

}  // namespace

TEST_CASE("a path of several steps ends in the same state as a path that has only the last step") {
  int compared = 0;
  for (std::uint64_t number = 0; number < problems; ++number) {
    random_problem p = make_random_problem(4, number);
    if (p.steps.size() == 1) continue;
    const followed many = follow(p);
    if (!many.determined()) continue;
    p.steps = {p.steps.back()};
    const followed one = follow(p);
    INFO(number);
    REQUIRE(one.solved());
    check_deflections(many, [&one](std::size_t node) { return one.deflection(node); });
    ++compared;
  }
  CHECK(compared > 150);
}

TEST_CASE("after loading and unloading, a structure held by supports has no deflection") {
  random_problem_kind kind;
  kind.free_share = 0.0;
  int loaded = 0;
  for (std::uint64_t number = 0; number < problems; ++number) {
    random_problem p = make_random_problem(5, number, kind);
    p.steps.emplace_back();
    const followed f = follow(p);
    INFO(number);
    REQUIRE(f.solved());
    check_deflections(f, [](std::size_t) { return 0.0; });
    loaded += f.largest() > 0.0 ? 1 : 0;
  }
  CHECK(loaded > 270);  // the other problems have all loads on supports
}

TEST_CASE("if loads and faces are 2^30 times as large, displacements are 2^30 times as large to the bit") {
  random_problem_kind held;  // without free structures, whose motion depends on decimals
  held.free_share = 0.0;
  check_same_path(6, 0x1p30, held);
}

TEST_CASE("if a problem is turned upside down, all numbers of the path only change sign, to the bit") {
  check_same_path(8, -1.0);
}

TEST_CASE("if a beam is mirrored, the deflections are mirrored too") {
  random_problem_kind kind;
  kind.plate_share = 0.0;
  int compared = 0;
  for (std::uint64_t number = 0; number < problems; ++number) {
    const random_problem p = make_random_problem(9, number, kind);
    const followed here = follow(p);
    const followed there = follow(other_way_round(p));
    INFO(number);
    CHECK(there.end.status == here.end.status);
    if (!here.determined() || !there.solved()) continue;
    const std::size_t last = here.nodes() - 1;
    check_deflections(here, [&there, last](std::size_t node) { return there.deflection(last - node); });
    ++compared;
  }
  CHECK(compared > 240);
}
