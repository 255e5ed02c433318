#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "catch.hpp"
#include "contct/model/line.hpp"
#include "contct/number/rational.hpp"
#include "contct/session/run_result.hpp"
#include "contct/session/step_results.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"

using namespace contct;

namespace {

problem reference_problem(const std::string& name) {
  return read_problem(CONTCT_REFERENCE "/problems/" + name + ".toml");
}

/// Returns the largest deflection at the ends of steps, and the largest difference between two runs.
std::pair<double, double> deflections(const a_run& a, const a_run& b) {
  double most = 0.0;
  double difference = 0.0;
  REQUIRE(a.result.record.steps.size() == b.result.record.steps.size());
  for (std::size_t step = 0; step < a.result.record.steps.size(); ++step) {
    const auto& u = a.result.record.steps[step].end.displacement;
    const auto& v = b.result.record.steps[step].end.displacement;
    REQUIRE(u.size() == v.size());
    for (int node = 0; node < nodes(a.what.geometry); ++node) {
      most = std::max(most, std::abs(deflection_of(a.what, u, node)));
      difference =
          std::max(difference, std::abs(deflection_of(a.what, u, node) - deflection_of(a.what, v, node)));
    }
  }
  return {most, difference};
}

const mesh_change& change_of(const std::vector<mesh_change>& all, std::string_view kind) {
  const auto found = std::ranges::find(all, kind, &mesh_change::kind);
  REQUIRE(found != all.end());
  return *found;
}

}  // namespace

TEST_CASE(
    "a problem with halved elements has the deflections of the reference problem that is written with these "
    "elements") {
  for (const auto& [coarse, fine] :
       {std::pair("pb11a-strip-footing-n20", "pb11b-strip-footing-n40"),
        {"pp01a-simply-supported-plate-n4", "pp01b-simply-supported-plate-n8"},
        {"pp02a-settled-column-n4", "pp02b-settled-column-n8"},
        {"pp03d-corners-and-settled-stop-n4", "pp03e-corners-and-settled-stop-n8"},
        {"pp05a-free-plate-on-bed-n8", "pp05c-free-plate-on-bed-n16"}}) {
    INFO(coarse);
    const a_run halved(refined(reference_problem(coarse)), "corrected");
    const a_run written(reference_problem(fine), "corrected");
    CHECK(halved.what.pairs.size() == written.what.pairs.size());
    CHECK(halved.what.supports.size() == written.what.supports.size());
    const auto [most, difference] = deflections(halved, written);
    CHECK(difference <= 1e-10 * most);
  }
}

TEST_CASE("The change by refinement is the difference between the extremes on the two meshes") {
  const a_run coarse(reference_problem("pb11a-strip-footing-n20"), "corrected");
  const a_run fine(refined(coarse.what), "corrected");
  const auto changes = changes_between(coarse.result, fine.result);
  // The pressures of 20 and 40 elements follow from w at the edge in reference/verification.toml.
  CHECK(change_of(changes, "pressure").of == Approx(3.327786).epsilon(1e-4));
  CHECK(change_of(changes, "pressure").change == Approx(3.327786 - 3.312101).epsilon(1e-2));
}

TEST_CASE("Refinement of a beam without a bed changes extremes only by rounding") {
  const std::string parts =
      "[beam]\nx = [0, 0.1, 0.7, 2]\nEI = [100, 200, 100]\n[[support]]\nnodes = [1, 4]\nfix = [\"w\"]\n"
      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.001\nstiffness = 1e4\n[[step]]\n"
      "uniform = [ { polynomial = [-8, 1], elements = [1, 3] } ]\npoint = [ { node = 2, w = -3, theta = 1 } "
      "]\n";
  const a_run coarse(parts, "corrected");
  const a_run fine(refined(coarse.what), "corrected");
  const auto changes = changes_between(coarse.result, fine.result);
  CHECK(changes.size() == 5);
  for (const char* kind : {"w", "moment", "shear", "force", "reaction"}) {
    INFO(kind);
    CHECK(change_of(changes, kind).of > 0.0);
    CHECK(change_of(changes, kind).change <= 1e-12 * change_of(changes, kind).of);
  }
  const auto& b = std::get<beam>(fine.what.geometry.kind);
  CHECK(line<rational>(b.x, b.runs).at(1) == rational(1) / 20);  // the middle of 0 and 0.1
  CHECK(line<rational>(b.x, b.runs).at(3) == rational(2) / 5);
}

TEST_CASE(
    "Refinement of a plate adds fixed nodes to a line of fixed nodes, with the mean of the settlements "
    "beside them") {
  const problem coarse = reference_problem("pp06-plate-over-settling-line");
  const problem fine = refined(coarse);  // 9 by 5 nodes
  CHECK(fine.supports.size() == coarse.supports.size() + 6);
  CHECK(fine.pairs.size() == coarse.pairs.size());
  CHECK(fine.pairs[1].node == 2 * 9 + 2);
  REQUIRE(fine.steps[0].settlements.size() == 5);
  for (const prescribed_displacement& g : fine.steps[0].settlements) {
    CHECK(g.node % 9 == 4);
    CHECK(g.value == Approx(-0.01).epsilon(1e-15));
  }
}

TEST_CASE(
    "Refinement gives a new node of a bed the mean of the faces beside it, or the value of the polynomial") {
  const std::string on_bed =
      "[beam]\nlength = 2\nelements = 2\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n[[bed]]\nmodulus = "
      "8\nface = ";
  const problem means = refined(parse_problem(on_bed + "[-1, -2, -4]\n[[step]]\nuniform = -1\n", "p.toml"));
  REQUIRE(means.pairs.size() == 4);  // the first node is fixed
  CHECK(means.pairs[0].face == -2.0);
  CHECK(means.pairs[2].face == -3.0);
  CHECK(means.pairs[3].stiffness == 2.0);
  const problem curve =
      refined(parse_problem(on_bed + "{ polynomial = [-1, 0, -1] }\n[[step]]\nuniform = -1\n", "p.toml"));
  CHECK(curve.pairs[0].face == -1.25);
  CHECK(curve.pairs[2].face == -3.25);
}

TEST_CASE(
    "Refinement of a matrix is refused, and the message suggests a finer mesh from the program that wrote "
    "it") {
  CHECK_THROWS_WITH(refined(parse_problem(portal_frame(), "frame.toml", reach::anywhere)),
                    Catch::Matchers::Contains("finer mesh with the program that wrote this one"));
}
