// Tests loads between nodes in exact arithmetic, and proved bounds on extremes inside elements.
#include <algorithm>
#include <sstream>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/model/extremes.hpp"
#include "contct/number/random.hpp"
#include "contct/read/problem_file.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

/// Returns the nodal forces of the only step of a beam with one element from 0 to 1.
rational_vector work_of(const std::string& step) {
  const problem p = parse_problem(
      "[beam]\nx = [0, 1]\nEI = 0.3\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[step]]\n" + step,
      "p.toml");
  return exact_problem_of(p).steps.at(0).force;
}

}  // namespace

TEST_CASE(
    "A force or moment at a quarter of an element has the exact nodal loads of the cubic shape functions") {
  CHECK(work_of("point = [ { x = 0.25, w = 64 } ]\n") == rational_vector{54, 9, 10, -3});
  CHECK(work_of("point = [ { x = 0.25, theta = 16 } ]\n") == rational_vector{-18, 3, 18, -5});
}

TEST_CASE("A load on a tenth of an element has exact nodal loads, and so has a curvature") {
  // The integrals of the shape functions from 0 to 1/10, such as L - L^3 + L^4 / 2.
  CHECK(work_of("uniform = [ { value = 1, to = 0.1 } ]\n") ==
        rational_vector{rational(1981, 20000), rational(523, 120000), rational(19, 20000),
                        rational(-37, 120000)});
  CHECK(work_of("curvature = [ { value = 10 } ]\n") == rational_vector{0, -3, 0, 3});
  CHECK(work_of("curvature = [ { value = 10, from = 0.5 } ]\n") ==
        rational_vector{rational(9, 2), rational(3, 4), rational(-9, 2), rational(15, 4)});
}

namespace {

struct drawn_load {
  std::string text;
  std::vector<int> places;  // in sixteenths of the element
};

/// Returns loads that begin, end and act at sixteenths of a beam from 0 to 4.
drawn_load draw_load(random_numbers& random) {
  std::ostringstream text;
  drawn_load drawn;
  const auto place = [&](int least, int most) {
    drawn.places.push_back(random.whole(least, most));
    return drawn.places.back() / 16.0;
  };
  const double from = place(1, 20);
  text << "uniform = [ { value = " << random.whole(-9, 9) << ", from = " << from << ", to = " << from + 1.25
       << " }, { polynomial = [" << random.whole(-9, 9) << ", " << random.whole(-9, 9)
       << ", 0.7], from = " << place(1, 60) << " } ]\n";
  drawn.places.push_back(drawn.places[0] + 20);
  text << "point = [ { x = " << place(1, 63) << ", w = " << random.whole(-9, 9)
       << " }, { x = " << place(1, 63) << ", theta = " << random.whole(-3, 3) << " } ]\n";
  text << "curvature = [ { value = " << random.whole(-9, 9) << "e-4, to = " << place(1, 63) << " } ]\n";
  drawn.text = text.str();
  return drawn;
}

problem on_nodes(const std::vector<int>& places, const std::string& step) {
  std::vector<int> sorted = places;
  sorted.insert(sorted.end(), {0, 32, 64});
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::ostringstream text;
  text << "[beam]\nx = [";
  for (const int i : sorted) text << i / 16.0 << ", ";
  text << "]\nEI = 1e3\n[[support]]\nx = [0, 4]\nfix = \"w\"\n[[contact]]\nx = 2\nsurface = \"below\"\n"
       << "face = -1e-3\nstiffness = 1e3\n[[step]]\n"
       << step;
  return parse_problem(text.str(), "p.toml");
}

struct told_extremes {
  certificate proof;
  std::vector<value_range> ranges;
  std::vector<std::pair<double, double>> slopes;  // x and slope at the right ends of the pieces of elements
};

told_extremes extremes_told_of(const problem& p) {
  const judged_run r(p, "corrected", false);
  told_extremes told{
      r.of_step(1),
      ranges_of(p.geometry, p.steps[0], r.displacements.at(0), {}, r.numbers.at(0).element_values),
      {}};
  const beam& b = std::get<beam>(p.geometry.kind);
  const beam_lines lines(b, p.steps[0], r.displacements.at(0), r.numbers.at(0).element_values);
  for (int e = 0; e < b.elements(); ++e)
    for (const element_line& piece : lines.pieces(e))
      told.slopes.emplace_back(piece.right, polynomial_at(piece.slope, 1.0));
  return told;
}

/// Checks the slopes of `told` against those of the mesh `fine`, which has a node at each of their places.
int check_slopes(const told_extremes& told, const problem& fine) {
  const rational_vector u = follow_corrected_path(exact_problem_of(fine)).steps.at(0).displacement;
  const std::vector<double>& x = std::get<beam>(fine.geometry.kind).x;
  int compared = 0;
  for (const auto& [at, slope] : told.slopes) {
    const std::size_t node = std::ranges::find(x, at) - x.begin();
    CHECK(abs(binary_value(slope) - u.at(2 * node + 1)) <= binary_value(*told.proof.error[quantity::slope]));
    ++compared;
  }
  return compared;
}

}  // namespace

TEST_CASE(
    "Extremes in two elements equal, within proved bounds, the extremes of a mesh with a node at each load") {
  random_numbers random(41);
  int slopes = 0;
  for (int number = 0; number < 100; ++number) {
    const drawn_load drawn = draw_load(random);
    CAPTURE(number, drawn.text);
    const told_extremes coarse = extremes_told_of(on_nodes({}, drawn.text));
    const told_extremes fine = extremes_told_of(on_nodes(drawn.places, drawn.text));
    REQUIRE(coarse.proof.certified);
    REQUIRE(fine.proof.certified);
    const quantity kinds[] = {quantity::w, quantity::moment, quantity::shear};
    for (std::size_t i = 0; i < 3; ++i) {
      const double bound = *coarse.proof.error[kinds[i]] + *fine.proof.error[kinds[i]];
      CHECK(std::abs(coarse.ranges[i].least.value - fine.ranges[i].least.value) <= bound);
      CHECK(std::abs(coarse.ranges[i].most.value - fine.ranges[i].most.value) <= bound);
      CHECK(bound < 1e-9);
    }
    if (number < 30) slopes += check_slopes(coarse, on_nodes(drawn.places, drawn.text));
  }
  CHECK(slopes > 150);
}
