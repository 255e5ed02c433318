#include "contct/write/step_results.hpp"

#include <fmt/format.h>

#include <vector>

#include "catch.hpp"
#include "contct/write/words.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/beams.hpp"
#include "support/structures.hpp"

using namespace contct::app;

namespace {

/// A simply supported beam of 12 lengths, EI = 1e4, with two stops at a third and two thirds.
problem beam_over_stops(double face, double q) {
  return parse_problem(
      "[beam]\nlength = 12.0\nelements = 3\nEI = 1e4\n[[support]]\nnodes = [1, 4]\nfix = [\"w\"]\n" +
          fmt::format("[[contact]]\nnode = 2\nsurface = \"below\"\nface = {0}\nstiffness = 1e9\n"
                      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = {0}\nstiffness = 1e9\n"
                      "[[step]]\nuniform = {1}\n",
                      face, q),
      "stops.toml");
}

/// Where its path ends, with the numbers read off there.
struct ended {
  explicit ended(const problem& p) {
    recorder seen;
    follow(p, structure_of(p), "refactor", *make_kernel("corrected"), {&seen});
    const auto& last = seen.steps.back();
    u = last.u;
    const load total = load_path(p).at(last.step, last.fraction);
    read = results_of(p, total, u, last.isep, deflecting_nodes(p));
    through = deepest_passage(p, total, u);
  }
  std::vector<double> u;
  step_results read;
  std::optional<passage> through;
};

/// The envelope of a run, as the page of all its frames would have it, and as every increment gives it.
struct enveloped {
  explicit enveloped(const std::string& text) : what(parse_problem(text, "pb.toml")), all(what) {
    const linear_structure s = structure_of(what);
    frame_keeper few(s, loads_of(what, s), true, {.most_frames = 4});
    few.show_each_to([this](const frame& f) { all.take(f); });
    follow(what, s, "refactor", *make_kernel("corrected"), {&few});
  }
  problem what;
  envelope all;
};

}  // namespace

TEST_CASE("The hardest pair and support are those of the largest force, the first one where two are equal") {
  const ended e(beam_over_stops(-0.001, -10.0));
  REQUIRE(e.read.pairs.size() == 2);
  CHECK(e.read.hardest_pair() == 0);  // both press with the same force but for rounding
  CHECK(e.read.pairs[0].force == Approx(e.read.pairs[1].force).epsilon(1e-9));
  CHECK(e.read.hardest_support(beam_over_stops(-0.001, -10.0)) == 0);
  const ended free(beam_over_stops(-10.0, -10.0));
  CHECK_FALSE(free.read.hardest_pair());
}

TEST_CASE("Forces, reactions and loads of a step's end balance, and its moments are the exact ones") {
  const ended e(beam_over_stops(-0.001, -10.0));
  double sum = -10.0 * 12;
  for (const double r : e.read.reactions) sum += r;
  for (const pair_reading& p : e.read.pairs) sum += p.force;
  CHECK(sum == Approx(0.0).margin(1e-7));
  const double edge = e.read.reactions[0];
  const value_range& m = e.read.ranges.at(1);
  CHECK(m.name == "moment");
  CHECK(m.most.value == Approx(edge * edge / 2 / 10.0).epsilon(1e-9));  // where the shear is zero: x = R / q
  CHECK(m.most.x == Approx(edge / 10.0).epsilon(1e-6));
}

TEST_CASE("A beam that sags through a face between two pairs is told, a flatter one is not") {
  const ended soft(beam_over_stops(0.0, -500.0));
  REQUIRE(soft.through);
  CHECK(soft.through->first == 0);
  CHECK(soft.through->second == 1);
  CHECK(soft.through->x == Approx(6.0).epsilon(1e-6));
  CHECK(soft.through->depth == Approx(500.0 * 256 / (1920 * 1e4)).epsilon(1e-3));  // q L^4 / (1920 EI)
  CHECK_FALSE(ended(beam_over_stops(-10.0, -1.0)).through);
  problem backwards = beam_over_stops(0.0, -500.0);  // named from the right to the left
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

TEST_CASE("An envelope has the largest of each quantity over all increments, with the increment") {
  const enveloped e(loaded_and_freed);
  const a_run run(loaded_and_freed);
  CHECK(e.all.states() == run.kept.increments());
  const envelope::range& w = e.all.ranges().front();
  CHECK(w.name == "w");
  const std::vector<frame>& frames = run.kept.frames();
  double least = 0.0;
  double force = 0.0;
  for (const frame& f : frames) {
    least = std::min(least, f.displacement[4]);
    for (std::size_t pair = 0; pair < 2; ++pair)
      force = std::max(force, pair == 0 ? reading_of(run.what, f, pair).force : 0.0);
  }
  CHECK(w.least.at.value == Approx(least).epsilon(1e-12));
  CHECK(w.least.reached.step == 1);
  CHECK(w.most.reached.step == 2);
  CHECK(e.all.pairs().at(0).force == Approx(force).epsilon(1e-12));
  CHECK(e.all.pairs().at(0).reached.step == 1);
  REQUIRE(e.all.reactions().size() == 2);
  CHECK(e.all.reactions()[0].most > 0.0);
  CHECK(e.all.reactions()[0].least < 0.0);
  CHECK(e.all.reactions()[0].least_reached.step == 2);
}

TEST_CASE("The end of a step is in the envelope as the path itself tells it, to the bit") {
  const enveloped e(good_problem);
  const a_run run(good_problem);
  CHECK(e.all.ranges().front().least.at.value == run.kept.frames().back().displacement[4]);
}

TEST_CASE("Places and units are in words: nodes with coordinates, places between nodes, labels") {
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

TEST_CASE("the warning of a beam that sags through a face names both pairs, from 1, and the step") {
  const problem p = beam_over_stops(0.0, -500.0);
  const linear_structure s = structure_of(p);
  run_recorder seen;
  (void)follow(p, s, "refactor", *make_kernel("fortran"), {&seen});
  CHECK_THAT(passage_warning(p, seen.steps),
             Catch::Matchers::StartsWith("step 1: between pairs 1 and 2 the beam passes through"));
}
