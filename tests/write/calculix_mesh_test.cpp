// Beams and plates in CalculiX's quadratic elements.
#include "contct/write/calculix_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::app;

namespace {

const std::string beam_text =
    "[beam]\nx = [0, 1, 2]\nEI = [1e4, 2e4]\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5e4\n"
    "[[step]]\nuniform = -6\n[[step]]\npoint = [ { node = 3, w = -60 }, { node = 2, theta = 4 } ]\n";

const std::string plate_text =
    "[plate]\nsize = [2, 1]\nelements = [2, 1]\nD = 1\nnu = 0.3\n[[support]]\nnodes = [1, 4]\n"
    "fix = [\"w\", \"wx\", \"wy\"]\n[[step]]\nuniform = -6\n";

double total_of(const calculix_mesh& m, int direction) {
  double sum = 0.0;
  for (const auto& [at, value] : m.forces) sum += at.second == direction ? value : 0.0;
  return sum;
}

bool fixes(const calculix_mesh& m, int node, int direction) {
  return std::any_of(m.fixed.begin(), m.fixed.end(),
                     [&](const auto& f) { return f.node == node && f.direction == direction; });
}

}  // namespace

TEST_CASE("each of a beam's elements becomes as many as asked for, with a node at every middle") {
  const problem p = parse_problem(beam_text, "pb.toml");
  for (const int refine : {1, 2, 5}) {
    const calculix_mesh m = calculix_mesh_of(p, refine, 0);
    CHECK(m.elements.size() == static_cast<std::size_t>(2 * refine));
    CHECK(m.nodes.size() == static_cast<std::size_t>(4 * refine + 1));
    for (const auto& e : m.elements) CHECK(e.size() == 3);
    CHECK(std::abs(total_of(m, 3) + 12) < 1e-12);  // uniform: all of it arrives
    CHECK(m.nodes[2].x == 2.0);
  }
}

TEST_CASE("a beam's slope turns against CalculiX's axis") {
  const calculix_mesh m = calculix_mesh_of(parse_problem(beam_text, "pb.toml"), 1, 1);
  CHECK(m.forces.at({1, 5}) == -4.0);
  CHECK(m.forces.at({2, 3}) == -60.0);
  CHECK(fixes(m, 0, 5));
}

TEST_CASE("a plate's edge that is fixed at its nodes is fixed between them") {
  const calculix_mesh m = calculix_mesh_of(parse_problem(plate_text, "pb.toml"), 2, 0);
  CHECK(m.elements.size() == 8);
  CHECK(std::abs(total_of(m, 3) + 12) < 1e-12);
  int on_edge = 0;
  for (std::size_t i = 0; i < m.nodes.size(); ++i) {
    const bool edge = m.nodes[i].x == 0.0;
    on_edge += edge ? 1 : 0;
    for (const int direction : {3, 4, 5}) CHECK(fixes(m, static_cast<int>(i), direction) == edge);
  }
  CHECK(on_edge == 5);
}

TEST_CASE("a plate's nodes that are fixed in w alone are points: between them it is free") {
  std::string text = plate_text;
  text.replace(text.find("[\"w\", \"wx\", \"wy\"]"), 17, "[\"w\"]\n[[support]]\nnode = 3\nfix = [\"w\"]");
  const calculix_mesh m = calculix_mesh_of(parse_problem(text, "pb.toml"), 2, 0);
  int held = 0;
  for (const auto& f : m.fixed) held += f.direction == 3 ? 1 : 0;
  CHECK(held == 3);
}
