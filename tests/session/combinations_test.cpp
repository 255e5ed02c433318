// Tests runs of combinations and trains against closed forms.
#include "catch.hpp"
#include "contct/session/step_results.hpp"
#include "support/a_run.hpp"

using namespace contct;

namespace {

/// A beam on supports at 0 and 1, with a stop of stiffness 6 at a distance of 0.4 below its end at 2. A load
/// P at the end moves it by 2 P / 3.
const std::string overhanging =
    "[beam]\nlength = 2\nelements = 2\nEI = 1\n[[support]]\nx = [0, 1]\nfix = \"w\"\n"
    "[[contact]]\nx = 2\nsurface = \"below\"\nface = -0.4\nstiffness = 6\n";
const std::string at_support = "point = [ { x = 1, w = -3 } ]\n";
const std::string at_end = "point = [ { x = 2, w = -3 } ]\n";

/// Two spans of length 10.
const std::string two_spans =
    "[beam]\nlength = 20\nelements = 20\nEI = 2e4\n[[support]]\nx = [0, 10, 20]\nfix = \"w\"\n";

/// Returns the moment over the middle support under a unit load at x: -a (L^2 - a^2) / (4 L^2) for spans L
/// and the distance a from the outer support.
double influence_on_middle_moment(double x) {
  if (x < 0.0 || x > 20.0) return 0.0;
  const double a = x <= 10.0 ? x : 20.0 - x;
  return -a * (100.0 - a * a) / 400.0;
}

}  // namespace

TEST_CASE(
    "An envelope has the values of the combinations, but not those of states between two combinations") {
  const a_run steps(overhanging + "[[step]]\n" + at_support + "[[step]]\n" + at_end);
  CHECK(envelope_of(steps.result).reactions[1].most.value == Approx(3.6));  // when the end reaches the stop
  const a_run run(overhanging + "[[case]]\nname = \"A\"\n" + at_support + "[[case]]\nname = \"B\"\n" +
                  at_end +
                  "[[combination]]\nname = \"1\"\nterms = { A = 1 }\n[[combination]]\nname = \"2\"\n"
                  "terms = { B = 1 }\n");
  const envelope all = envelope_of(run.result);
  CHECK(all.states == 2);
  CHECK(all.reactions[1].most.value == Approx(3.0));
  CHECK(all.reactions[1].most.step == 1);
  CHECK(all.reactions[1].least.value == Approx(2.16));  // 2 (3 - 1.92)
  CHECK(all.pairs[0].value == Approx(1.92));            // (2 - 0.4) / (2 / 3 + 1 / 6)
  CHECK((all.pairs[0].step == 2 && all.pairs[0].increment == 2));
}

TEST_CASE("Moving axles make the moment over the middle support that follows from the influence line") {
  const a_run run(two_spans +
                  "[[train]]\nname = \"T\"\naxles = [ { at = 0, w = -35 }, { at = 4, w = -145 } ]\n"
                  "from = -3\nto = 20\nby = 1\nfactor = 1.5\n");
  const run_result& r = run.result;
  REQUIRE(r.record.steps.size() == 24);
  for (int k = 0; k < 24; ++k) {
    const double x = k - 3;
    const double moment =
        1.5 * (35 * influence_on_middle_moment(x) + 145 * influence_on_middle_moment(x + 4));
    const structure_state& end = r.record.steps[static_cast<std::size_t>(k)].end;
    const element_results in_elements =
        results_in_elements(r.what.geometry, r.what.steps[static_cast<std::size_t>(k)], end.displacement);
    CHECK(in_elements.at(9, 1)[1] == Approx(moment).epsilon(1e-9).margin(1e-9));
  }
  CHECK(r.judged.all_certified());
}

TEST_CASE("States within a combination are computed from the unloaded structure") {
  a_run run(overhanging + "[[case]]\nname = \"A\"\n" + at_support + "[[case]]\nname = \"B\"\n" + at_end +
            "[[combination]]\nname = \"1\"\nterms = { A = 1 }\n[[combination]]\nname = \"2\"\n"
            "terms = { B = 1 }\n");
  path_states states(run.result);
  const path_moment first = moments_of(run.result).at(1);  // the stop makes contact
  CHECK(first.increment->fraction == Approx(0.2));
  CHECK(states.at(first).displacement[4] == Approx(-0.4));
  CHECK(load_path(run.what).resultant_at(2, 0.2).force == Approx(-0.6));
}

TEST_CASE("find_final_states finds the states of combinations without a path, even after a mechanism") {
  const problem p = parse_problem(
      "[beam]\nlength = 4\nelements = 4\nEI = 100\n[[contact]]\nx = [0, 4]\nsurface = \"below\"\nface = 0\n"
      "stiffness = 1e4\n[[case]]\nname = \"down\"\nuniform = -1\n[[combination]]\nname = \"lifts\"\n"
      "terms = { down = -1 }\n[[combination]]\nname = \"rests\"\nterms = { down = 2 }\n",
      "pb.toml");
  const linear_structure s = structure_of(p);
  certifier judged(p, s);
  run_recorder record;
  const std::vector<observer*> all = {&judged, &record};
  const path_end end = judged.find_final_states(all);
  CHECK((end.status == path_status::mechanism && end.step == 1));
  REQUIRE(record.steps.size() == 1);
  CHECK(record.steps[0].end.step == 2);
  CHECK(record.steps[0].end.displacement[0] == Approx(-4.0 / 1e4));
}
