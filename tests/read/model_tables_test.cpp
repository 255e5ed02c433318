// [beam] and [plate] in their forms. What is refused is in bad_inputs.hpp and bad_plates.hpp.
#include "contct/read/model_tables.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "contct/read/contact_face.hpp"
#include "read/refusals.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

model model_in(const std::string& text) {
  const toml::table document = parse_toml(text, "m.toml");
  return read_model(table_reader(document, "", "m.toml"), "");
}

std::string refusal(const std::string& text) {
  return verdict([&] { (void)model_in(text); });
}

contact_pair face_in(const std::string& text, int default_surface) {
  const toml::table document = parse_toml(text, "m.toml");
  return read_face(table_reader(document, "contact[1]", "m.toml"), default_surface);
}

}  // namespace

TEST_CASE("node i of a beam of n equal elements is at length * i / n, to the bit") {
  const beam b = std::get<beam>(model_in("[beam]\nlength = 0.7\nelements = 3\nEI = 2\n").kind);
  CHECK(b.x == std::vector<double>{0.0, 0.7 * 1 / 3, 0.7 * 2 / 3, 0.7 * 3 / 3});
  CHECK(b.EI == std::vector<double>{2, 2, 2});
}

TEST_CASE("a plate's D is E t^3 / 12 (1 - nu^2), or what is written") {
  const std::string grid = "[plate]\nsize = [2, 1]\nelements = [2, 1]\nnu = 0.5\n";
  const plate p = std::get<plate>(model_in(grid + "E = 9\nthickness = 2\n").kind);
  CHECK(p.D == Approx(8.0).epsilon(1e-15));
  CHECK(p.x == std::vector<double>{0, 1, 2});
  CHECK(p.y == std::vector<double>{0, 1});
  CHECK(std::get<plate>(model_in(grid + "D = 3\n").kind).D == 3.0);
}

TEST_CASE("a document has exactly one structure") {
  CHECK_THAT(refusal("title = \"x\"\n"),
             Contains("the file: found neither beam nor plate, matrix or calculix"));
  CHECK_THAT(refusal("[beam]\n[plate]\n"), Contains("m.toml:2:1: plate: found this beside beam"));
  CHECK_THAT(refusal("[calculix]\n[beam]\n"), Contains("m.toml:1:1: calculix: found this beside beam"));
}

TEST_CASE("the largest plate that is allowed takes 4 GB") {
  const auto square = [](int n) {
    const std::string text = std::to_string(n);
    return refusal("[plate]\nsize = [1, 1]\nelements = [" + text + ", " + text + "]\nD = 1\nnu = 0\n");
  };
  // 3 (n + 1)^2 rows of 3 (n + 2) + 3 entries
  const auto entries = [](std::int64_t n) { return 3 * (n + 1) * (n + 1) * (3 * (n + 2) + 3); };
  int n = 1;
  while (entries(n + 1) <= 500'000'000) ++n;
  CHECK(square(n) == "accepted");
  CHECK_THAT(square(n + 1), Contains("whose stiffness matrix takes 4.0 GB"));
}

TEST_CASE("a face below is in contact at 0, open beneath, and inside the structure above") {
  CHECK(face_in("face = 0.0\n", face_below).closed);
  CHECK_FALSE(face_in("face = 0\nstate = \"separated\"\n", face_below).closed);
  const contact_pair open = face_in("surface = \"above\"\nface = 0.5\n", face_below);
  CHECK(open.surface == face_above);
  CHECK(open.face == 0.5);
  CHECK_FALSE(open.closed);
  CHECK_THAT(verdict([] { (void)face_in("face = 0.5\n", face_below); }), Contains("inside the undeformed"));
  CHECK_THAT(verdict([] { (void)face_in("face = 0\n", 0); }), Contains("contact[1].surface: found nothing"));
}
