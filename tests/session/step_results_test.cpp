#include "contct/session/step_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/number/random.hpp"
#include "contct/write/words.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"

using namespace contct;

namespace {

/// Returns a simple beam of length 12, EI = 1e4, with stops at one third and two thirds.
problem beam_over_stops(double face, double q) {
  return parse_problem(
      "[beam]\nlength = 12.0\nelements = 3\nEI = 1e4\n[[support]]\nnodes = [1, 4]\nfix = [\"w\"]\n" +
          fmt::format("[[contact]]\nnode = 2\nsurface = \"below\"\nface = {0}\nstiffness = 1e9\n"
                      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = {0}\nstiffness = 1e9\n"
                      "[[step]]\nuniform = {1}\n",
                      face, q),
      "stops.toml");
}

/// The final state of a path, and its results.
struct ended {
  explicit ended(const problem& p) {
    const a_run run(p, "corrected");
    const structure_state& last = run.result.record.steps.back().end;
    read = results_of(p, p.steps.back(), last);
    through = deepest_penetration(p, p.steps.back(), last.displacement);
  }
  step_results read;
  std::optional<penetration> through;
};

}  // namespace

TEST_CASE("hardest_pair and hardest_supports give the largest force, and of equal forces the first") {
  const ended e(beam_over_stops(-0.001, -10.0));
  REQUIRE(e.read.pairs.size() == 2);
  CHECK(e.read.hardest_pair() == 0);  // both forces are equal except for rounding
  CHECK(e.read.pairs[0].force == Approx(e.read.pairs[1].force).epsilon(1e-9));
  CHECK(e.read.hardest_supports(beam_over_stops(-0.001, -10.0)) == std::vector<std::size_t>{0});
  const ended free(beam_over_stops(-10.0, -10.0));
  CHECK_FALSE(free.read.hardest_pair());
  // One loaded span of two: the middle support has the largest reaction, and the last one pulls.
  const problem uplift = parse_problem(loaded_span, "uplift.toml");
  CHECK(ended(uplift).read.hardest_supports(uplift) == std::vector<std::size_t>{1, 2});
}

TEST_CASE(
    "Loads, reactions and contact forces at the end of a step balance, and the extreme moment is exact") {
  const ended e(beam_over_stops(-0.001, -10.0));
  double sum = -10.0 * 12;
  for (const double r : e.read.reactions) sum += r;
  for (const pair_reading& p : e.read.pairs) sum += p.force;
  CHECK(sum == Approx(0.0).margin(1e-7));
  const double edge = e.read.reactions[0];
  const value_range& m = e.read.ranges.at(1);
  CHECK(m.name == "moment");
  CHECK(m.most.value == Approx(edge * edge / 2 / 10.0).epsilon(1e-9));  // the shear is 0 at x = R / q
  CHECK(m.most.x == Approx(edge / 10.0).epsilon(1e-6));
}

TEST_CASE(
    "In every reference beam and plate, loads, reactions and contact forces add up to 0 within rounding") {
  int compared = 0;
  for (const auto& file : std::filesystem::directory_iterator(CONTCT_REFERENCE "/problems")) {
    if (file.path().extension() != ".toml") continue;
    const a_run run(read_problem(file.path().string()), "corrected");
    // Matrices have no direction "up".
    if (std::holds_alternative<assembled>(run.what.geometry.kind)) continue;
    for (const step_record& s : run.result.record.steps) {
      const load& acting = run.what.steps[s.end.step - 1];
      const step_results read = results_of(run.what, acting, s.end);
      const auto sums = balance_of(run.what, acting, read);
      REQUIRE(sums);
      double size = std::abs(sums->loads);
      for (const double r : read.reactions) size += std::abs(r);
      for (const pair_reading& pair : read.pairs) size += std::abs(pair.force);
      INFO(file.path().filename().string() << ", step " << s.end.step);
      CHECK(std::abs(sums->loads + sums->reactions + sums->contact) <= 1e-12 * size);
      ++compared;
    }
  }
  CHECK(compared >= 60);
}

TEST_CASE("In the balance of a step, the contact force of a face above counts downwards") {
  const a_run run(loaded_and_freed, "corrected");  // the second step presses the beam upwards
  const load& acting = run.what.steps[1];
  const auto sums =
      balance_of(run.what, acting, results_of(run.what, acting, run.result.record.steps[1].end));
  REQUIRE(sums);
  CHECK(sums->loads == 60.0);
  CHECK(sums->contact < 0.0);
  CHECK(sums->reactions == Approx(-60.0 - sums->contact).epsilon(1e-12));
}

TEST_CASE("Far from x = 0, bearing pressures are within their bound, and lengths in contact are exact") {
  random_numbers random(3);
  for (int number = 0; number < 20; ++number) {
    std::string x;
    const double start = std::pow(10.0, random.whole(3, 7));
    for (int tenth = 0; tenth < 20; tenth += random.whole(1, 4))
      x += fmt::format("{:.1f}, ", start + 0.1 * tenth);
    const problem p = parse_problem("[beam]\nx = [" + x +
                                        "]\nEI = 1\n[[bed]]\nmodulus = 7\nface = 0\n[[step]]\n"
                                        "uniform = -3\npoint = [ { node = 2, w = -2 } ]\n",
                                    "far.toml");
    const a_run run(p, "corrected");
    const structure_state& end = run.result.record.steps[0].end;
    const bed_reading read = beds_in(p, results_of(p, p.steps[0], end), end).at(0);
    const exact_problem exactly = exact_problem_of(p);
    const exact_step_end truly = follow_corrected_path(exactly).steps.at(0);
    rational length;
    rational least(1000);
    rational most;
    for (std::size_t i = 0; i < exactly.pairs.size(); ++i) {
      const rational pressure = 7 * truly.force[i] / exactly.pairs[i].stiffness;
      least = std::min(least, pressure);
      most = std::max(most, pressure);
      if (truly.closed[i] != 0) length += exactly.pairs[i].stiffness / 7;
    }
    CAPTURE(number, x);
    const double bound = run.result.judged.steps()[0]->pressure.value();
    CHECK(std::abs(contct::rounded(binary_value(read.pressure.least.value) - least)) <= bound);
    CHECK(std::abs(contct::rounded(binary_value(read.pressure.most.value) - most)) <= bound);
    CHECK(bound < 1e-12);
    CHECK(read.contact == Approx(contct::rounded(length)).epsilon(1e-15));
  }
}

TEST_CASE("The pressure under a half-lifted footing is that of a rigid body on the springs in contact") {
  const a_run run(read_problem(CONTCT_REFERENCE "/problems/pb11a-strip-footing-n20.toml"), "corrected");
  const structure_state& end = run.result.record.steps[0].end;
  const std::vector<bed_reading> beds = beds_in(run.what, results_of(run.what, run.what.steps[0], end), end);
  REQUIRE(beds.size() == 1);
  // Solves p = a + b x at the nodes from 0 to 0.6, with tributary lengths, for a sum of 1 and a moment about
  // x = 0 of 0.2.
  double s0 = 0.0;
  double s1 = 0.0;
  double s2 = 0.0;
  for (int i = 0; i <= 12; ++i) {
    const double x = 0.05 * i;
    const double share = i == 0 ? 0.025 : 0.05;
    s0 += share;
    s1 += share * x;
    s2 += share * x * x;
  }
  CHECK(beds[0].pressure.most.value == Approx((s2 - 0.2 * s1) / (s0 * s2 - s1 * s1)).epsilon(1e-3));
  CHECK(beds[0].pressure.most.value == Approx(10.0 / 3).epsilon(7e-3));  // SEAINT: 2 P / (Y B), Y = 0.6
  CHECK(beds[0].pressure.most.x == 0.0);
  CHECK(beds[0].pressure.least.value == 0.0);
  CHECK(beds[0].contact == Approx(0.625).epsilon(1e-12));
  CHECK(beds[0].force == Approx(1.0).epsilon(1e-12));  // the load
}

TEST_CASE(
    "A beam that sags through the face between two pairs is reported, but a beam above the face is not") {
  const ended soft(beam_over_stops(0.0, -500.0));
  REQUIRE(soft.through);
  CHECK(soft.through->first == 0);
  CHECK(soft.through->second == 1);
  CHECK(soft.through->x == Approx(6.0).epsilon(1e-6));
  CHECK(soft.through->depth == Approx(500.0 * 256 / (1920 * 1e4)).epsilon(1e-3));  // q L^4 / (1920 EI)
  CHECK_FALSE(ended(beam_over_stops(-10.0, -1.0)).through);
  problem backwards = beam_over_stops(0.0, -500.0);  // its pairs are named from right to left
  std::ranges::reverse(backwards.pairs);
  const ended same(backwards);
  REQUIRE(same.through);
  CHECK(same.through->x == soft.through->x);
  CHECK(same.through->first == backwards.pairs.size() - 1);
  problem other_face = beam_over_stops(0.0, -500.0);
  other_face.pairs[1].face = -1e-9;
  other_face.pairs[1].closed = false;
  CHECK_FALSE(ended(other_face).through);
}

TEST_CASE(
    "An envelope has the largest value of each quantity over all increments, and the step of this value") {
  const a_run run(loaded_and_freed, "corrected");
  const envelope all = envelope_of(run.result);
  const std::vector<structure_state> states = pictures_of(run.result);
  CHECK(all.states == static_cast<int>(states.size()) - 1);  // all but the unloaded state
  double least = 0.0;
  double force = 0.0;
  for (const structure_state& s : states) {
    if (s.step == 0) continue;
    least = std::min(least, s.displacement[4]);
    force = std::max(force, results_of(run.what, {}, s).pairs[0].force);
  }
  CHECK(all.names.front() == "w");
  const auto& w = all.values.front();
  CHECK(w.least.value.value == least);
  CHECK(w.least.step == 1);
  CHECK(w.most.step == 2);
  CHECK(all.pairs.at(0).value == Approx(force).epsilon(1e-12));
  CHECK(all.pairs.at(0).step == 1);
  REQUIRE(all.reactions.size() == 2);
  CHECK(all.reactions[0].most.value > 0.0);
  CHECK(all.reactions[0].least.value < 0.0);
  CHECK(all.reactions[0].least.step == 2);
}

TEST_CASE("A place is described by node and coordinates, and a value has a unit if the problem has units") {
  problem p = parse_problem(good_problem, "pb.toml");
  CHECK(place_words(p.geometry, placed_value{1.0, 2.0, 0.0, 2}) == "node 3, x = 2");
  CHECK(place_words(p.geometry, placed_value{1.0, 0.5, 0.0, -1}) == "x = 0.5");
  CHECK(unit_words(p, "w").empty());
  p.units = {"m", "kN"};
  CHECK(unit_words(p, "w") == " m");
  CHECK(unit_words(p, "moment") == " kN m");
  CHECK(unit_words(p, "shear") == " kN");
  CHECK(unit_words(p, "theta").empty());
  CHECK(ranges_are_at(p.geometry) == "the whole length");
  const problem plate = parse_problem(good_plate, "plate.toml");
  CHECK(place_words(plate.geometry, placed_value{1.0, 1.0, 0.5, 2}) == "node 3, (1, 0.5)");
  CHECK(ranges_are_at(plate.geometry) == "nodes and corners of elements");
}

TEST_CASE("if a beam sags through a face between two pairs, the warning names the step and both pairs") {
  const a_run run(beam_over_stops(0.0, -500.0));
  CHECK_THAT(passage_warning(run.what, run.result.record.steps),
             Catch::Matchers::StartsWith("step 1: between pairs 1 and 2 the beam passes through"));
}

TEST_CASE("the deflection at a pair gives a gap if the pair is separated, and a force if it is in contact") {
  const problem p = parse_problem(good_problem, "pb.toml");  // face -0.004, stiffness 5e4
  const pair_reading open = reading_of(p.pairs[0], -0.001, false);
  CHECK(open.gap == Approx(0.003));
  CHECK(open.force == 0.0);
  CHECK(open.look == pair_state::open);
  const pair_reading closed = reading_of(p.pairs[0], -0.005, true);
  CHECK(closed.gap == 0.0);
  CHECK(closed.force == Approx(50.0));
  CHECK(closed.look == pair_state::closed);
  CHECK(reading_of(p.pairs[0], -0.004, false).look == pair_state::at_face);
}

TEST_CASE("translations of a matrix with coordinates count as deflections, without coordinates all dofs") {
  const problem placed = parse_problem(portal_frame(), "p.toml", reach::anywhere);
  const std::vector<int> dofs = deflecting_nodes(placed);
  CHECK(dofs.size() == 22);
  CHECK(std::none_of(dofs.begin(), dofs.end(), [](int dof) { return dof % 3 == 2; }));
  const problem bare = parse_problem(frame_without_coordinates(), "p.toml", reach::anywhere);
  CHECK(deflecting_nodes(bare).size() == 33);
}

TEST_CASE("nodes of a plate are numbered along x first, and w is the first dof of each node") {
  const problem p = parse_problem(good_plate, "pb.toml");
  CHECK(place_of_node(p.geometry, 4).x == 0.5);
  CHECK(place_of_node(p.geometry, 4).y == 1.0);
  CHECK(place_name(p.geometry, 4) == "5");
  std::vector<double> u(18);
  u[12] = 7.0;
  CHECK(deflection_of(p, u, 4) == 7.0);
}

TEST_CASE("an extreme of the envelope is in the first of the states with this value, except for rounding") {
  int compared = 0;
  for (const std::string load : {"-8", "-0.7", "3.3"}) {
    std::string text = propped_cantilever;
    for (const std::string next : {"-0.3", load.c_str(), "-0.1", load.c_str()})
      text += "[[step]]\nuniform = " + next + "\n";
    const a_run run(text.replace(text.find("-8.0"), 4, load));
    for (const auto& v : envelope_of(run.result).values)
      for (const auto& at : {v.least, v.most}) {
        CAPTURE(load, at.value.value, at.step);
        CHECK(at.step < 4);
        ++compared;
      }
  }
  CHECK(compared == 18);
}
