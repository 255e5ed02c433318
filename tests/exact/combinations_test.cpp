// Tests exact combinations against loads multiplied by hand and against closed forms.
#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;

namespace {

exact_problem read(const std::string& text) {
  return exact_problem_of(parse_problem(text, "problem.toml"));
}

const std::string over_stops =
    "[beam]\nlength = 3\nelements = 3\nEI = 10\n[[support]]\nx = 0\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nx = [1, 2, 3]\nsurface = \"below\"\nface = [-0.01, 0, -0.02]\nstiffness = 70\n";

const std::string cases =
    "[[case]]\nname = \"G\"\nuniform = [ { value = -0.1 }, { polynomial = [0.3, -0.2], elements = [2] } ]\n"
    "[[case]]\nname = \"P\"\npoint = [ { x = 3, w = 1.1 } ]\nsettlement = [ { x = 0, w = 0.003 } ]\n"
    "[[case]]\nname = \"S\"\npoint = [ { x = 3, w = -0.3, theta = 0.7 } ]\n"
    "settlement = [ { x = 0, w = -0.001 } ]\n";

const std::string combined = over_stops + cases +
                             "[[combination]]\nname = \"1\"\nterms = { S = 3 }\n"
                             "[[combination]]\nname = \"2\"\nterms = { G = 1.35, P = 0.7, S = 1.1 }\n";

/// The second combination multiplied by hand: 1.35 * 0.1, 1.35 * 0.3, 0.7 * 1.1 - 1.1 * 0.3, 0.7 * 0.003 -
/// 1.1 * 0.001, ..
const std::string by_hand =
    over_stops +
    "[[step]]\nuniform = [ { value = -0.135 }, { polynomial = [0.405, -0.27], elements = [2] } ]\n"
    "point = [ { x = 3, w = 0.44, theta = 0.77 } ]\nsettlement = [ { x = 0, w = 0.001 } ]\n";

/// A beam of length 4 on two stops at its ends.
const std::string lies =
    "[beam]\nlength = 4\nelements = 4\nEI = 100\n[[contact]]\nx = [0, 4]\nsurface = \"below\"\nface = 0\n"
    "stiffness = 1e4\n[[case]]\nname = \"down\"\nuniform = -1\n[[case]]\nname = \"up\"\n"
    "point = [ { x = 1, w = 7 } ]\n"
    "[[combination]]\nname = \"lifts\"\nterms = { down = 1, up = 1 }\n"
    "[[combination]]\nname = \"rests\"\nterms = { down = 2, up = 0.5 }\n";

}  // namespace

TEST_CASE(
    "the exact path of a combination equals that of a step with the sum of factor times load of all cases") {
  for (const auto follow : {follow_corrected_path, follow_1989_path}) {
    const exact_path of_cases = follow(read(combined), {});
    const exact_path of_one_step = follow(read(by_hand), {});
    REQUIRE(of_cases.steps.size() == 2);
    const exact_step_end& a = of_cases.steps[1];
    const exact_step_end& b = of_one_step.steps.at(0);
    CHECK(a.displacement == b.displacement);
    CHECK(a.force == b.force);
    CHECK(a.reactions == b.reactions);
    CHECK(a.closed == b.closed);
    REQUIRE(a.increments.size() == b.increments.size());
    for (std::size_t i = 0; i < a.increments.size(); ++i)
      CHECK(a.increments[i].fraction == b.increments[i].fraction);
  }
}

TEST_CASE("in the exact path, a combination after a mechanism still starts from the unloaded structure") {
  for (const auto follow : {follow_corrected_path, follow_1989_path}) {
    const exact_path path = follow(read(lies), {});
    CHECK(path.status == path_status::mechanism);
    REQUIRE(path.steps.size() == 2);
    CHECK(path.steps[0].status == path_status::mechanism);
    CHECK(path.steps[0].fraction < rational(1, 1000));
    CHECK(path.steps[1].status == path_status::solved);
    // The downward loads add up to 8, and 3.5 acts upwards at x = 1.
    CHECK(path.steps[1].force == rational_vector{rational(11, 8), rational(25, 8)});
  }
}
