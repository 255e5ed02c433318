// Tests the forms of [beam] and [plate]; bad_inputs.hpp and bad_plates.hpp list their refusals. For [matrix]
// and [calculix], tests the named files, the storage of K, and refusals before K is allocated.
#include <fmt/format.h>

#include <cmath>

#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/read/tables.hpp"
#include "read/refusals.hpp"
#include "read/small_matrix.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

model model_in(const std::string& text) {
  const toml::table document = parse_toml(text, "m.toml");
  std::vector<std::string> warnings;
  return read_model(toml_value(document, "m.toml"), {"m.toml", reach::own_folder}, warnings);
}

std::string refusal(const std::string& text) {
  return verdict([&] { (void)model_in(text); });
}

}  // namespace

TEST_CASE("node i of a beam of n equal elements is at length * i / n, to the bit") {
  const beam b = std::get<beam>(model_in("[beam]\nlength = 0.7\nelements = 3\nEI = 2\n").kind);
  CHECK(b.x == std::vector<double>{0.0, 0.7 * 1 / 3, 0.7 * 2 / 3, 0.7 * 3 / 3});
  CHECK(b.EI == std::vector<double>{2, 2, 2});
}

TEST_CASE("the stiffness D of a plate is E t^3 / 12 (1 - nu^2), or the D of the file") {
  const std::string grid = "[plate]\nsize = [2, 1]\nelements = [2, 1]\nnu = 0.5\n";
  const plate p = std::get<plate>(model_in(grid + "E = 9\nthickness = 2\n").kind);
  CHECK(p.D == Approx(8.0).epsilon(1e-15));
  CHECK(p.x == std::vector<double>{0, 1, 2});
  CHECK(p.y == std::vector<double>{0, 1});
  CHECK(std::get<plate>(model_in(grid + "D = 3\n").kind).D == 3.0);
}

TEST_CASE(
    "the largest plate that is accepted has a stiffness matrix of 4 GB, and a larger plate is refused") {
  const auto square = [](int n) {
    const std::string text = std::to_string(n);
    return refusal("[plate]\nsize = [1, 1]\nelements = [" + text + ", " + text + "]\nD = 1\nnu = 0\n");
  };
  // The band has 3 (n + 1)^2 rows of 3 (n + 2) + 3 entries.
  const auto entries = [](std::int64_t n) { return 3 * (n + 1) * (n + 1) * (3 * (n + 2) + 3); };
  int n = 1;
  while (entries(n + 1) <= 500'000'000) ++n;
  CHECK(square(n) == "accepted");
  CHECK_THAT(square(n + 1), Contains("whose stiffness matrix takes 4.0 GB"));
}

namespace {

std::string message_of(const std::string& path) {
  return verdict([&] { (void)read_problem(path); });
}

const char* const a_step = "[[step]]\npoint = [ { dof = \"1\", value = 1 } ]\n";

}  // namespace

TEST_CASE(
    "dofs of a matrix without labels are named by number, and the file may set storage and free_motions") {
  const scratch_folder here;
  (void)here.write("K.mtx", small_matrix);
  const auto read = [&](const std::string& keys) {
    const problem p = read_problem(here.write("p.toml", "[matrix]\nstiffness = \"K.mtx\"\n" + keys + a_step));
    return std::get<assembled>(p.geometry.kind);
  };
  const assembled a = read("");
  CHECK(a.dofs() == 3);
  CHECK(a.label_of(2) == "3");
  CHECK(a.as_band);
  CHECK_FALSE(a.free_motions.has_value());
  CHECK_FALSE(a.places.known());
  CHECK(read("free_motions = 2\n").free_motions == 2);
  CHECK(read("storage = \"band\"\n").as_band);
  if (sparse_factor::available()) CHECK_FALSE(read("storage = \"sparse\"\n").as_band);
}

TEST_CASE("CalculiX's mesh is read from the file of the key mesh, or else from the .inp file of the job") {
  const scratch_folder here;
  (void)here.write("job.sti", "1 1 2\n1 2 -1\n2 2 2\n");
  (void)here.write("job.dof", "2.3\n3.3\n");
  const std::string mesh =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,9,9,9\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";
  const auto with_mesh = [&](const std::string& key) {
    return here.write("p.toml", "[calculix]\njob = \"job\"\n" + key +
                                    "[[step]]\npoint = [ { dof = \"2.3\", value = 1 } ]\n");
  };
  const auto places = [&](const std::string& key) {
    return std::get<assembled>(read_problem(with_mesh(key)).geometry.kind).places;
  };
  CHECK_FALSE(places("").known());
  (void)here.write("other.inp", mesh);
  CHECK(places("mesh = \"other.inp\"\n").edges.size() == 6);
  CHECK_FALSE(places("").known());
  (void)here.write("job.inp", mesh);
  const placed_nodes found = places("");
  CHECK(found.nodes.size() == 4);
  CHECK(found.edges.size() == 6);
  CHECK(found.dofs[1].node == 2);
  CHECK(found.dofs[1].direction == 3);
  // Input files of other jobs in the same folder are not used.
  (void)here.write("job.inp", "*NODE\n8,0,0,0\n");
  CHECK_FALSE(places("").known());
  CHECK_THAT(places("").notes.at(0),
             Catch::Matchers::Contains("no label of a dof, such as \"2.3\", names a node of "));
  CHECK_THAT(message_of(with_mesh("mesh = \"job.inp\"\n")),
             Catch::Matchers::Contains("p.toml:3:8: calculix.mesh: found no node of") &&
                 Catch::Matchers::Contains("allowed: labels NODE.DIRECTION"));
  CHECK_THAT(message_of(with_mesh("mesh = \"none.inp\"\n")),
             Catch::Matchers::Contains("none.inp: cannot be read"));
  (void)here.write("job.inp", "*NODE\n2,0,0,x\n");
  CHECK_THAT(message_of(with_mesh("")), Catch::Matchers::Contains("job.inp:2: found \"x\" for a coordinate"));
}

TEST_CASE(
    "a matrix whose band exceeds the memory is refused before allocation, but is accepted in sparse "
    "storage") {
  const scratch_folder here;
  // The last row of this matrix is full in any order of rows.
  constexpr int n = 400'000;
  std::string arrow =
      fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{} {} {}\n", n, n, 2 * n - 1);
  for (int i = 1; i < n; ++i) arrow += fmt::format("{} {} 2\n{} {} -1e-6\n", i, i, n, i);
  (void)here.write("arrow.mtx", arrow + fmt::format("{} {} 2\n", n, n));
  const auto message_with = [&](const std::string& key) {
    return message_of(here.write("p.toml", "[matrix]\nstiffness = \"arrow.mtx\"\n" + key + a_step));
  };
  const std::string remedy = sparse_factor::available() ? "storage = \"sparse\"" : "build with CHOLMOD";
  const auto is_refused = [&](const std::string& key) {
    const std::string message = message_with(key);
    CHECK_THAT(message, Contains("p.toml:1:1: matrix: found 400000 dofs with a half bandwidth of"));
    CHECK_THAT(message, Contains("GiB, three quarters of this machine's memory; " + remedy + "; condense"));
  };
  is_refused("storage = \"band\"\n");
  if (sparse_factor::available())  // sparse storage has few entries and no fill-in
    CHECK(message_with("") == "accepted");
  else
    is_refused("");
}

TEST_CASE("each piece of EI extends from the end of the previous piece to the coordinate `to`") {
  const auto of = [](const std::string& lines) {
    return std::get<beam>(
        parse_problem("[beam]\n" + lines + "[[step]]\nuniform = 1\n", "pb.toml").geometry.kind);
  };
  CHECK(of("x = [0, 1, 2, 4]\nEI = [ { to = 2.0, value = 5 }, { to = 4, value = 7 } ]\n").EI ==
        std::vector<double>{5, 5, 7});
  CHECK(of("length = 1\nelements = 10\nEI = [ { to = 0.3, value = 5 }, { to = 1, value = 7 } ]\n").EI ==
        std::vector<double>{5, 5, 5, 7, 7, 7, 7, 7, 7, 7});
  const beam sized =
      of("length = 10\nelement_size = 4\nEI = [ { to = 2.5, value = 5 }, { to = 10.0, value = 7 } ]\n");
  CHECK(sized.x == std::vector<double>{0, 2.5, 6.25, 10});
  CHECK(sized.EI == std::vector<double>{5, 7, 7});
}
