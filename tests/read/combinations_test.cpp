// Tests combinations and trains as steps with factors. bad_combinations.hpp lists the refusals.
#include "catch.hpp"
#include "contct/model/line.hpp"
#include "contct/number/rational.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_combinations.hpp"

using namespace contct;

namespace {

std::vector<load> steps_of(const std::string& tables) {
  return parse_problem(cases_with(tables), "pb.toml").steps;
}

std::vector<std::string> names_of(const std::vector<load>& steps) {
  std::vector<std::string> names;
  for (const load& l : steps) names.push_back(l.name);
  return names;
}

const std::string two_cases =
    "[[case]]\nname = \"G\"\nuniform = [ { value = -3 }, { value = 0.1 } ]\nsettlement = [ { x = 0, w = -0.1 "
    "} ]\n"
    "[[case]]\nname = \"crane left\"\npoint = [ { x = 1, w = -0.7 } ]\nsettlement = [ { x = 0, w = -0.2 } "
    "]\n";

}  // namespace

TEST_CASE("a combination has the sum of factor times load of its cases, and starts from zero") {
  const auto steps =
      steps_of(two_cases + "[[combination]]\nname = \"ULS\"\nterms = { \"crane left\" = 1.5, G = 1.35 }\n");
  REQUIRE(steps.size() == 1);
  const load& l = steps[0];
  CHECK(l.name == "ULS");
  CHECK(l.from_zero);
  REQUIRE(l.terms.size() == 2);  // in the order of the cases
  CHECK((l.terms[0].name == "G" && l.terms[0].factor == 1.35 && !l.terms[0].at));
  CHECK((l.terms[1].name == "crane left" && l.terms[1].factor == 1.5));
  REQUIRE(l.points.size() == 1);
  CHECK((l.points[0].node == 1 && l.points[0].value == -0.7 && l.points[0].factor == 1.5));
  REQUIRE(l.distributed.size() == 1);
  CHECK(l.distributed[0].polynomial == std::vector<double>{-3.915});  // 1.35 * -2.9, rounded once
  REQUIRE(l.distributed[0].parts.size() == 2);
  CHECK((l.distributed[0].parts[1].coefficients[0] == 0.1 && l.distributed[0].parts[1].factor == 1.35));
  REQUIRE(l.settlements.size() == 2);
  CHECK((l.settlements[0].factor == 1.35 && l.settlements[1].factor == 1.5));
}

TEST_CASE(
    "the steps of combinations come before the steps of trains, and both are in the order of the file") {
  const std::string train = "axles = [ { at = 0, w = 1 } ]\nfrom = 0\nto = 1\nby = 1\n";
  CHECK(names_of(steps_of(two_cases + "[[train]]\nname = \"T\"\n" + train +
                          "[[combination]]\nname = \"B\"\nterms = { G = 1 }\n[[combination]]\nname = \"A\"\n"
                          "terms = { G = 2 }\n")) == std::vector<std::string>{"B", "A", "T at 0", "T at 1"});
}

TEST_CASE("a train is placed at `from`, and then every `by` farther as long as `to` is not exceeded") {
  const auto places = [](const std::string& numbers) {
    return names_of(parse_problem("[beam]\nlength = 1\nelements = 10\nEI = 1\n[[support]]\nx = [0, 1]\n"
                                  "fix = \"w\"\n[[train]]\nname = \"T\"\naxles = [ { at = 0, w = -1 } ]\n" +
                                      numbers,
                                  "pb.toml")
                        .steps);
  };
  CHECK(places("from = 0.1\nto = 0.3\nby = 0.1\n") ==  // the decimal 0.1 + 2 * 0.1 is 0.3
        std::vector<std::string>{"T at 0.1", "T at 0.2", "T at 0.3"});
  CHECK(places("from = 0\nto = 0.59\nby = 0.3\n") == std::vector<std::string>{"T at 0", "T at 0.3"});
  CHECK(places("from = 0.5\nto = 0.5\nby = 2\n") == std::vector<std::string>{"T at 0.5"});
}

TEST_CASE("an axle acts at the exact sum of decimals, and does not act beyond the beam by any distance") {
  const auto axles = [](const std::string& beam, const std::string& numbers) {
    const problem p = parse_problem("[beam]\n" + beam +
                                        "\nEI = 1\n[[support]]\nx = 0\nfix = [\"w\", \"theta\"]\n[[train]]\n"
                                        "name = \"T\"\naxles = [ { at = 1e-17, w = -1 } ]\n" +
                                        numbers,
                                    "pb.toml");
    const auto& b = std::get<contct::beam>(p.geometry.kind);
    std::vector<std::string> places;
    for (const load& l : p.steps) {
      REQUIRE(l.points.size() + l.placed.size() < 2);
      for (const point_load& at : l.points) places.push_back("node " + std::to_string(at.node + 1));
      for (const placed_load& at : l.placed)
        places.push_back(fraction_words(line<rational>(b.x, b.runs).place(at.from) * 1000));
    }
    return places;
  };
  CHECK(axles("x = [0, 1, 2]", "from = 0\nto = 2\nby = 1\n") ==
        std::vector<std::string>{"1/100000000000000", "100000000000000001/100000000000000"});
  CHECK(axles("x = [0, 1e-17, 5]", "from = 0\nto = 3e-30\nby = 1.2345678901234567e-30\n") ==
        std::vector<std::string>{
            "node 2", "100000000000012345678901234567/10000000000000000000000000000000000000000000",
            "50000000000012345678901234567/5000000000000000000000000000000000000000000"});
}

TEST_CASE("each axle of a train has the factor of the train, and an axle beyond the beam does not act") {
  const auto steps =
      parse_problem(train_with("from = -1\nto = 3\nby = 1\nfactor = 1.5\nterms = { G = 2 }\n"), "pb.toml")
          .steps;
  REQUIRE(steps.size() == 5);
  REQUIRE(steps[0].points.size() == 1);
  CHECK((steps[0].points[0].node == 0 && steps[0].points[0].value == -2 && steps[0].points[0].factor == 1.5));
  REQUIRE(steps[1].points.size() == 2);
  CHECK((steps[1].points[0].node == 0 && steps[1].points[0].value == -1));
  CHECK((steps[1].points[1].node == 1 && steps[1].points[1].value == -2));
  CHECK(steps[3].points.size() == 1);
  CHECK(steps[4].points.empty());
  CHECK(steps[4].distributed[0].polynomial == std::vector<double>{-2});
  REQUIRE(steps[4].terms.size() == 2);
  CHECK((steps[4].terms[1].factor == 1.5 && steps[4].terms[1].at == 3.0));
}
