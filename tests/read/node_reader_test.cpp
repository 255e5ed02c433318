// Tests how a table names nodes: by numbers, coordinates, grid points and labels.
#include "contct/read/node_reader.hpp"

#include <fmt/format.h>

#include "catch.hpp"
#include "read/refusals.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

const model a_beam{beam{{0.0, 0.3, 0.5, 2.0}, {1, 1, 1}}};
const model a_plate{plate{{0.0, 0.5, 1.0}, {0.0, 2.0}, 1.0, 0.3}};

model a_matrix() {
  assembled a;
  a.stiffness.order = 3;
  a.labels = {"1.1", "1.2", "top"};
  return {a};
}

std::vector<int> nodes_in(const model& m, const std::string& text) {
  const toml::table document = parse_toml(text, "f.toml");
  return node_reader(m).read(toml_value(document, "f.toml"));
}

std::string refusal(const model& m, const std::string& text) {
  return verdict([&] { (void)nodes_in(m, text); });
}

}  // namespace

TEST_CASE("nodes of a beam are given by a number, a list, a range, one x or several x") {
  CHECK(nodes_in(a_beam, "node = 2") == std::vector<int>{1});
  CHECK(nodes_in(a_beam, "nodes = [4, 1]") == std::vector<int>{3, 0});
  CHECK(nodes_in(a_beam, "nodes = \"2..3\"") == std::vector<int>{1, 2});
  CHECK(nodes_in(a_beam, "x = 2") == std::vector<int>{3});
  CHECK(nodes_in(a_beam, "x = [2.0, 0.3, 0]") == std::vector<int>{3, 1, 0});
}

TEST_CASE("nodes of a plate are given by the word all, one point or several points") {
  CHECK(nodes_in(a_plate, "nodes = \"all\"").size() == 6);
  CHECK(nodes_in(a_plate, "at = [0.5, 2]") == std::vector<int>{4});
  CHECK(nodes_in(a_plate, "at = [[1, 0], [0.0, 2.0]]") == std::vector<int>{2, 3});
  CHECK_THAT(refusal(a_plate, "at = [[1, 0], [1.0, 0.0]]"), Contains("at[2]: found node 3, a second time"));
  CHECK_THAT(refusal(a_plate, "at = []"), Contains("at: found an empty array; allowed: [x, y], or a list"));
  CHECK_THAT(refusal(a_plate, "at = [1, 0, 0]"), Contains("at: found an array of 3; allowed: [x, y]"));
  CHECK_THAT(refusal(a_plate, "at = [[1, 0], 3]"), Contains("at[2]: found 3; allowed: [x, y]"));
  CHECK_THAT(refusal(a_plate, "at = [0.7, 0]"),
             Contains("at[1]: found 0.7, where there is no grid line along x; allowed: the coordinate of a "
                      "grid line along x; the nearest are 0.5 and 1"));
}

TEST_CASE("dofs of a matrix are given by one label or several labels, and no label may occur twice") {
  const model m = a_matrix();
  CHECK(nodes_in(m, "dof = \"top\"") == std::vector<int>{2});
  CHECK(nodes_in(m, "dofs = [\"top\", \"1.1\"]") == std::vector<int>{2, 0});
  CHECK_THAT(refusal(m, "dofs = [\"top\", \"top\"]"), Contains("dofs[2]: found dof top, a second time"));
  CHECK_THAT(refusal(m, "dof = \"1.3\""),
             Contains("dof: found \"1.3\", which has no row: a dof that is fixed or depends on others") &&
                 !Contains("did you mean"));
  CHECK_THAT(refusal(m, "dof = \"1.11\""), Contains("found \"1.11\" (did you mean \"1.1\"?)"));
  CHECK_THAT(refusal(m, "dof = \"1\""), Contains("such as \"1.1\""));
}

TEST_CASE("dofs of a matrix without labels are given by their numbers, in one spelling only") {
  assembled a;
  a.stiffness.order = 12;
  CHECK(nodes_in({a}, "dof = \"12\"") == std::vector<int>{11});
  for (const char* no : {"0", "13", "-1", "1.0", "01", "+1", " 1", "", "99999999999999", "x"})
    CHECK_THAT(refusal({a}, fmt::format("dof = \"{}\"", no)), Contains("a label, \"1\" to \"12\""));
}

TEST_CASE("a table gives nodes in exactly one way, and the message about missing nodes lists all ways") {
  CHECK_THAT(refusal(a_beam, "x = 0\nnodes = [1]"),
             Contains("f.toml:2:9: nodes: found this key together with x; allowed: either nodes or x"));
  CHECK_THAT(refusal(a_beam, ""),
             Contains("node: found nothing: this key is missing; allowed: a whole number from 1 to 4; or "
                      "nodes or x instead of node"));
  CHECK_THAT(refusal(a_plate, ""), Contains("; or nodes or at instead of node"));
  CHECK_THAT(refusal(a_matrix(), ""), Contains("dof: found nothing: this key is missing; allowed: a label"));
}
