// Tests sections, self-weight and hinges of problem files.
#include "catch.hpp"
#include "contct/model/elements.hpp"
#include "contct/number/rational.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_inputs.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

const std::string on_two = "[[support]]\nx = [0, 10]\nfix = \"w\"\n";

problem on_two_supports(const std::string& lines, const std::string& step = "uniform = 1\n") {
  return parse_problem("[beam]\n" + lines + on_two + "[[step]]\n" + step, "pb.toml");
}

const beam& beam_in(const problem& p) {
  return std::get<beam>(p.geometry.kind);
}

}  // namespace

TEST_CASE(
    "EI is the same if given in pieces of a section or in pieces of EI, and each piece ends at a node") {
  const problem by_EI = on_two_supports(
      "length = 10\nelement_size = 4\nEI = [ { to = 2.5, value = 5 }, { to = 10.0, value = 7 } ]\n");
  const problem by_section = on_two_supports(
      "length = 10\nelement_size = 4\nsection = [ { to = 2.5, E = 10, I = 0.5 }, { to = 10.0, E = 14, I = "
      "0.5 } ]\n");
  CHECK(beam_in(by_section).EI == beam_in(by_EI).EI);
  CHECK(beam_in(by_section).x == beam_in(by_EI).x);
}

TEST_CASE("EI of a section is the product of the decimals E and I, rounded once") {
  const problem p =
      on_two_supports("x = [0, 10]\nsection = { E = 0.1, I = 0.7 }\n");  // in doubles 0.1 * 0.7 is below 0.07
  CHECK(beam_in(p).EI == std::vector<double>{0.07});
  CHECK(elements_of<rational>(beam_in(p)).EI(0) == rational(7, 100));
}

TEST_CASE("The self-weight of a beam is one load for all elements with the same weight and area") {
  const problem p = on_two_supports(
      "length = 10\nelement_size = 2.5\nsection = [ { to = 5, E = 1, I = 1, A = 0.5, weight = 80 }, "
      "{ to = 7.5, E = 2, I = 1, A = 0.5, weight = 80 }, { to = 10, E = 1, I = 1, A = 0.25, weight = 80 } "
      "]\n",
      "self_weight = true\n");
  const load& l = p.steps.at(0);
  REQUIRE(l.distributed.size() == 2);
  CHECK(l.distributed[0].polynomial == std::vector<double>{-40});
  CHECK(l.distributed[0].elements == std::vector<int>{0, 1, 2});
  CHECK(l.distributed[1].polynomial == std::vector<double>{-20});
  CHECK(resultant_of(p.geometry, l).force == -350);
}

TEST_CASE(
    "Self-weight weight * A bends a simple beam like a uniform load of this size, and is added to other "
    "loads") {
  const problem p =
      on_two_supports("length = 10\nelements = 2\nsection = { E = 1, I = 1, A = 0.2, weight = 40 }\n",
                      "self_weight = true\nuniform = -2\n");
  const load& l = p.steps.at(0);
  const std::vector<double> u = displaced(p.geometry, p.supports, l);
  CHECK(results_in_elements(p.geometry, l, u).at(0, 1)[1] == Approx((40 * 0.2 + 2) * 100 / 8).epsilon(1e-12));
}

TEST_CASE("self_weight = false removes the self-weight of the previous step") {
  const problem p = on_two_supports("x = [0, 10]\nsection = { E = 1, I = 1, A = 0.2, weight = 40 }\n",
                                    "self_weight = true\n[[step]]\nself_weight = false\n");
  CHECK(p.steps.at(1).distributed.empty());
}

TEST_CASE("The self-weight of a plate is a pressure of weight times thickness") {
  const problem p = parse_problem(
      "[plate]\nsize = [2, 1]\nelements = [2, 1]\nE = 9\nnu = 0.5\nthickness = 0.3\nweight = 0.1\n"
      "[[step]]\nself_weight = true\n",
      "pp.toml");
  CHECK(p.steps.at(0).distributed.at(0).polynomial == std::vector<double>{-0.03});
  CHECK(coefficients_of<rational>(p.steps.at(0).distributed[0]) == std::vector<rational>{rational(-3, 100)});
}

TEST_CASE("Hinges are sorted from left to right, and with element_size there is a node at each hinge") {
  const problem p = on_two_supports("length = 10\nelement_size = 5\nEI = 1\n[[hinge]]\nx = [7, 3]\n");
  CHECK(beam_in(p).x == std::vector<double>{0, 3, 7, 10});
  CHECK(beam_in(p).hinges == std::vector<int>{1, 2});
}
