// Tests the factor of K with springs, the springs that engines apply, and the engines that keep a factor.

#include "catch.hpp"
#include "contct/linear/sparse_factor.hpp"
#include "contct/linear/spring_engine.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

/// Returns a cantilever with EI = 1e4 whose pairs are separated, with springs from softer to stiffer than the
/// beam.
linear_structure cantilever_over_stops(int elements) {
  std::vector<contact_pair> pairs;
  for (int i = 1; i <= elements; ++i) pairs.push_back({i, -1, -0.01, std::pow(10.0, 2 + i % 4), false});
  return build(even_beam(0.5 * elements, elements, 1e4), std::vector<support>{{0, 0, true}, {0, 1, true}},
               pairs);
}

/// Returns a plate that is clamped along x = 0 and wider than high, so that its rows and its dofs have
/// different orders.
linear_structure wide_plate() {
  const plate p{{0, 1, 2, 3}, {0, 1}, 50.0, 0.3};
  std::vector<support> clamp;
  for (const int node : {0, 4})
    for (int dof = 0; dof < 3; ++dof) clamp.push_back({node, dof, true});
  return build(p, clamp, {{3, -1, 0.0, 20.0, false}, {7, -1, 0.0, 30.0, false}});
}

/// Returns a structure of three dofs with a pair at each dof, and rows in the reverse order of dofs. The
/// first dof is fixed.
linear_structure three_dofs() {
  linear_structure s;
  s.dofs_per_node = 1;
  band_matrix k(3, 1);
  for (int row = 0; row < 3; ++row) k.at(row, row) = 4.0;
  k.at(1, 0) = -1.0;
  s.stiffness = k;
  s.stiffness.fix(std::vector<double>{0, 0, 1});
  s.rows = {2, 1, 0};
  s.fixed = {1, 0, 0};
  for (int node = 0; node < 3; ++node) s.pairs.push_back({node, -1, 0.0, 10.0 + node, false});
  return s;
}

/// Returns the response at the pairs, computed with a new factor.
std::vector<double> response_by_factor(const linear_structure& s, const std::vector<char>& closed,
                                       std::vector<double> load) {
  factored_stiffness k(s);
  k.factor(closed);
  k.solve(load);
  std::vector<double> at_pairs(s.pairs.size());
  gather_at_pairs(s, load, at_pairs);
  return at_pairs;
}

/// Returns the largest difference between two vectors relative to the largest entry.
double relative_difference(std::span<const double> a, std::span<const double> b) {
  double size = 0.0, off = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    size = std::max(size, std::abs(a[i]));
    off = std::max(off, std::abs(a[i] - b[i]));
  }
  return off / size;
}

/// An engine of a structure under a load that is 1 at every dof, or has the given values.
struct engine_under_load {
  engine_under_load(const char* name, linear_structure structure, std::vector<double> given = {})
      : s(std::move(structure)), load(given.empty() ? std::vector<double>(s.dofs(), 1.0) : std::move(given)) {
    engine = make_engine(name, s);
  }

  /// Changes the status of a pair, from 0.
  void toggle(int pair) {
    closed[pair] = closed[pair] == 0 ? 1 : 0;
    engine->switch_spring(pair, closed[pair] != 0);
  }
  std::vector<double> respond(double share = 1.0) {
    std::vector<double> d_star(s.pairs.size());
    engine->respond({load, share, 1}, d_star);
    return d_star;
  }
  /// Returns the difference of the response from that of a new factor.
  double off() { return relative_difference(response_by_factor(s, closed, load), respond()); }

  linear_structure s;
  std::vector<double> load;
  std::vector<char> closed = std::vector<char>(s.pairs.size());
  std::unique_ptr<stiffness_engine> engine;
};

/// Returns the loads of a cantilever of 12 elements with forces at its tip and at another dof.
std::vector<double> two_forces(int dof, double force) {
  std::vector<double> load(26);
  load[24] = -10.0;
  load[dof] = force;
  return load;
}

/// An engine of four pairs that records the order in which springs are applied.
class recording_engine final : public spring_engine {
 public:
  explicit recording_engine(const linear_structure& s) : spring_engine(s, usual_factor(s.stiffness)) {}
  void respond(const residual_load& /*residual*/, std::span<double> /*d_star*/) override {
    order.clear();
    accepted = apply_switched([this](int pair) {
      order.push_back(pair);
      return pair != refused;
    });
    if (!accepted) apply_all();
  }
  void factor_wanted() override {}

  /// Switches springs, responds, and returns the order in which springs are applied.
  std::vector<int> switched(const std::vector<std::pair<int, bool>>& springs) {
    for (const auto& [pair, closed] : springs) switch_spring(pair, closed);
    respond({{}, 1.0}, {});
    return order;
  }
  [[nodiscard]] const std::vector<char>& applied() const { return applied_; }
  std::vector<int> order;
  int refused = -1;
  bool accepted = true;
};

linear_structure with_pairs(const std::vector<bool>& closed) {
  beam_problem p{even_beam(1.0, 4, 1.0), {}, {}, {}};
  for (int i = 0; i < 4; ++i) p.pairs.push_back({i, -1, 0.0, 1.0, closed[i]});
  return p.structure();
}

/// Checks a response of -1.
bool accepts(drift_monitor& m, double correction) {
  m.include(-1.0, correction);
  return m.accepts();
}

/// Returns the number of responses until a check is due.
int responses_until_due(drift_monitor& m) {
  int count = 1;
  while (!m.is_due()) ++count;
  return count;
}

}  // namespace

TEST_CASE("a cantilever with a spring k under its tip deflects by F / (3 EI / L^3 + k)") {
  const linear_structure s = cantilever_over_stops(4);  // L = 2, EI = 1e4; k = 100 at the tip
  factored_stiffness k(s);
  std::vector<double> u(s.dofs());
  u[8] = 5.0;
  u[0] = 7.0;  // a load on a fixed dof
  k.factor(std::vector<char>{0, 0, 0, 1});
  k.solve(u);
  CHECK(u[8] == Approx(5.0 / (3e4 / 8 + 100)).epsilon(1e-12));
  CHECK(u[0] == 0.0);
}

TEST_CASE("the columns of the inverse at the pairs equal the solutions for unit loads at the pairs") {
  for (const bool by_cholmod : {false, true}) {
    if (by_cholmod && !sparse_factor::available()) continue;
    for (linear_structure s : {cantilever_over_stops(5), wide_plate()}) {
      s.pairs.push_back({0, -1, 0.0, 20.0, false});  // at a fixed dof
      factored_stiffness k(s, by_cholmod ? sparse_factor::make(s.stiffness) : usual_factor(s.stiffness));
      k.factor(std::vector<char>(s.pairs.size(), 1));
      const std::vector<int> pairs = {1, static_cast<int>(s.pairs.size()) - 1, 0};
      const std::vector<std::vector<double>> columns = k.columns_at_pairs(pairs);
      REQUIRE(columns.size() == pairs.size());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::vector<double> e(s.dofs()), expected(s.pairs.size());
        e[s.pairs[pairs[i]].dof] = 1.0;
        k.solve(e);
        gather_at_pairs(s, e, expected);
        for (std::size_t p = 0; p < expected.size(); ++p)
          CHECK(columns[i].at(p) == Approx(expected[p]).epsilon(1e-12).margin(1e-16));
      }
    }
  }
}

TEST_CASE("after refinement, the residual of a solution is only rounding") {
  const linear_structure s = wide_plate();
  const std::vector<char> closed = {1, 0};
  factored_stiffness k(s);
  k.factor(closed);
  std::vector<double> load(s.dofs()), u(s.dofs());
  load[9] = -1.0;
  load[22] = 0.5;
  k.solve_refined(load, u);
  for (const double entry : residual(s.stiffness, springs_of(s, closed), in_rows(s, load), in_rows(s, u)))
    CHECK(std::abs(entry) <= 2e-14);
}

TEST_CASE("a structure with supports is refused if its matrix cannot be factored") {
  linear_structure s = cantilever_over_stops(3);
  s.stiffness.at(4, 4) = -1.0;
  factored_stiffness k(s);
  CHECK_THROWS_AS(k.factor(std::vector<char>(3)), no_factor);
  CHECK(k.reciprocal_condition(std::vector<char>(3)) == 0.0);
}

TEST_CASE("springs, loads and forces are put in the rows of their dofs, but no spring at a fixed dof") {
  const linear_structure s = three_dofs();
  const std::vector<spring_at> springs = springs_of(s, std::vector<char>{1, 0, 1});
  REQUIRE(springs.size() == 1);
  CHECK(springs[0].row == 0);
  CHECK(springs[0].stiffness == 12.0);
  const std::vector<double> load = {5, 6, 7};
  CHECK(in_rows(s, load) == std::vector<double>{7, 6, 0});
  std::vector<double> at_pairs(3);
  gather_at_pairs(s, load, at_pairs);
  CHECK(at_pairs == load);
  CHECK(with_pair_forces(s, load, std::vector<double>{1, -1, 0.5}) == std::vector<double>{5, 5, 7.5});
  // The residual is b - K x minus the forces of the springs.
  CHECK(residual(s.stiffness, springs, std::vector<double>{100, 10, 0}, std::vector<double>{2, 3, 0}) ==
        std::vector<double>{100 - (4 * 2 - 3 + 12 * 2), 10 - (4 * 3 - 2), 0});
}

TEST_CASE("corrections make an inexact solver precise, and a growing correction is not applied") {
  const linear_structure s = three_dofs();
  const std::vector<spring_at> springs = {{0, 12.0}};
  std::vector<double> u(3);
  int solves = 0;
  const auto jacobi = [&solves](double factor) {  // approximate: ignores the coupling of -1
    return [&solves, factor](std::span<double> b) {
      ++solves;
      b[0] *= factor / 16;
      b[1] *= factor / 4;
    };
  };
  solve_refined(s, springs, jacobi(1.0), std::vector<double>{9, 1, 15}, u);
  // 16 x0 - x1 = 15 and 4 x1 - x0 = 1, where row 0 is dof 2.
  CHECK(u[0] == 0.0);
  CHECK(u[1] == Approx(31.0 / 63).epsilon(1e-5));
  CHECK(u[2] == Approx(61.0 / 63).epsilon(1e-5));
  CHECK(solves == 7);  // one solve, and at most six corrections
  solves = 0;
  solve_refined(s, springs, jacobi(-1.0), std::vector<double>{0, 1, 15}, u);
  CHECK(solves == 3);  // the second correction is larger, and not applied
}

TEST_CASE("an engine adds new springs before it removes others, and changes each spring once") {
  const linear_structure s = with_pairs({false, false, false, false});
  recording_engine e(s);
  CHECK(e.switched({{3, true}, {3, false}}).empty());  // on and off again before a response
  CHECK(e.switched({{2, true}, {0, true}}) == std::vector<int>{2, 0});
  CHECK(e.switched({{2, false}, {1, true}, {1, true}}) == std::vector<int>{1, 2});
  CHECK(e.applied() == std::vector<char>{1, 1, 0, 0});
  CHECK(e.switched({}).empty());
}

TEST_CASE("the springs of pairs in contact at the start are in the first factor of an engine") {
  const linear_structure s = with_pairs({true, false, true, false});
  recording_engine e(s);
  e.refused = 1;
  CHECK(e.applied() == std::vector<char>{0, 0, 0, 0});
  CHECK(e.switched({{1, true}, {3, true}}) ==
        std::vector<int>{1});  // no spring is applied after the refused spring
  CHECK_FALSE(e.accepted);
  CHECK(e.applied() == std::vector<char>{1, 1, 1, 1});
}

TEST_CASE("the interval between drift checks doubles while the drift is negligible, or is halved") {
  drift_monitor good(8), bad(8);
  for (const int interval : {8, 16, 32, 64, 128, 128}) {
    CHECK(responses_until_due(good) == interval);
    CHECK(accepts(good, 1e-12));
  }
  for (const int interval : {8, 4, 4}) {
    CHECK(responses_until_due(bad) == interval);
    CHECK_FALSE(accepts(bad, 5e-11));
  }
  CHECK(accepts(bad, 5e-12));
  CHECK(responses_until_due(bad) == 4);
  // A check can be requested for the next response, and its interval can be restarted.
  drift_monitor m(8);
  m.check_next();
  CHECK(m.is_due());
  m.start_interval();
  CHECK(responses_until_due(m) == 8);
}

TEST_CASE("the drift of a response is relative to the largest response of any pair") {
  drift_monitor m(8);
  CHECK(m.accepts());
  for (const auto& [correction, accepted] : {std::pair(-4e-11, true), {-5e-11, false}}) {
    m.include(-4.0, 0.0);
    m.include(2.0, correction);
    CHECK(m.accepts() == accepted);
  }
}

TEST_CASE("when a pair toggles, the updated engine gives the response of a new factor without a new factor") {
  engine_under_load e("updated", cantilever_over_stops(12), two_forces(9, 3.0));
  (void)e.respond();
  for (const int pair : {11, 4, 0, 11, 7}) {
    e.toggle(pair);
    CHECK(e.off() <= 1e-10);
  }
  CHECK(e.engine->counts().updates == 5);
  CHECK(e.engine->counts().factors == 1);
  CHECK(e.engine->counts().solves == 1 + 5);  // the load, and a column for each toggle
}

TEST_CASE("the updated engine checks the drift after 16 responses, and then after 32 more") {
  engine_under_load e("updated", cantilever_over_stops(6));
  e.toggle(2);
  (void)e.respond();
  e.toggle(1);  // a first update, which needs a check
  for (const auto& [responses, checks] : {std::pair(15, 0), {1, 1}, {31, 1}, {1, 2}}) {
    for (int i = 0; i < responses; ++i) (void)e.respond();
    CHECK(e.engine->counts().checks == checks);
  }
}

TEST_CASE("the updated engine takes a new factor after it removes a much stiffer spring") {
  linear_structure s = cantilever_over_stops(6);
  s.pairs[5].stiffness = 1e9;
  engine_under_load e("updated", s);
  (void)e.respond();
  for (const int factors : {1, 2}) {
    e.toggle(5);
    (void)e.respond();
    CHECK(e.engine->counts().factors == factors);
  }
  CHECK(e.engine->counts().updates == 1);
  CHECK(e.off() <= 1e-12);
}

TEST_CASE("beams with pairs can be condensed to the pairs, but plates and beams without pairs cannot") {
  CHECK(can_be_condensed(cantilever_over_stops(3)));
  linear_structure bare = cantilever_over_stops(3);
  bare.pairs.clear();
  CHECK_FALSE(can_be_condensed(bare));
  CHECK_FALSE(can_be_condensed(wide_plate()));
  CHECK_THROWS_AS(make_engine("condensed", wide_plate()), std::invalid_argument);
}

TEST_CASE("the condensed engine gives the response of a full factorisation, whichever nodes have pairs") {
  const linear_structure all = cantilever_over_stops(12);
  for (const std::vector<int>& kept : {std::vector{0, 5, 11}, {3}, {10, 11}, {0, 1, 2, 8}}) {
    linear_structure s = all;
    s.pairs.clear();
    for (const int i : kept) s.pairs.push_back(all.pairs[i]);
    engine_under_load e("condensed", s, two_forces(7, 4.0));
    CHECK(e.off() <= 1e-12);
    for (std::size_t i = 0; i < 2 * kept.size(); ++i) {
      e.toggle(static_cast<int>(i % kept.size()));
      std::vector<double> half = response_by_factor(s, e.closed, e.load);
      for (double& d : half) d *= 0.5;
      CHECK(relative_difference(half, e.respond(0.5)) <= 1e-10);
    }
    CHECK(e.engine->counts().factors == 1);
    CHECK(e.engine->counts().updates == static_cast<std::int64_t>(2 * kept.size()));
  }
}

TEST_CASE("a pair at a fixed dof has the response 0 in the condensed engine") {
  linear_structure s = cantilever_over_stops(4);
  s.pairs.push_back({0, -1, 0.0, 1e6, false});
  engine_under_load e("condensed", s);
  const std::vector<double> before = e.respond();
  e.toggle(4);
  CHECK(e.respond() == before);
  CHECK(before[4] == 0.0);
}

TEST_CASE("the condensed engine adds all springs before the first response of a free beam") {
  engine_under_load e(
      "condensed",
      build(beam{{0, 1, 2}, {605, 605}}, {}, {{0, -1, -1e-4, 300.0, false}, {2, -1, -5e-5, 250.0, false}}),
      {0, 0, -2.0, 0, 0, 0});
  e.toggle(0);
  e.toggle(1);
  const std::vector<double> d_star = e.respond();
  CHECK(d_star[0] == Approx(-1.0 / 300).epsilon(1e-12));
  CHECK(d_star[1] == Approx(-1.0 / 250).epsilon(1e-12));
}

TEST_CASE("after a spring 1e18 times as stiff is removed, the condensed engine has the response before") {
  linear_structure s = cantilever_over_stops(6);
  s.pairs[2].stiffness *= 1e18;
  std::vector<double> load(14);
  load[12] = -10.0;
  engine_under_load e("condensed", s, load);
  const std::vector<double> before = e.respond();
  for (const bool closed : {true, false}) {
    e.toggle(2);
    CHECK((relative_difference(before, e.respond()) <= 1e-12) != closed);
  }
  const engine_counts counts = e.engine->counts();
  CHECK(counts.checks >= 1);
  CHECK(counts.solves == counts.factors + counts.checks);  // one for each factor, and one for each check
}

TEST_CASE("if a beam is too ill-conditioned, the condensed engine is made but fails at the first response") {
  // A mechanism with elements of length 1 and 1e7, whose path needs no response.
  const beam b{{-1, 0, 1, 2, 3, 4, 10000004, 20000004, 30000004}, std::vector<double>(8, 1e7)};
  engine_under_load e("condensed",
                      build(b, std::vector{support{7, 1, false, 1e7, false}}, {{7, 1, 1e7, 1e7, false}}));
  CHECK_THROWS_AS(e.respond(), no_factor);
  CHECK_THROWS_AS(e.respond(), no_factor);
}
