// Tests that large structures take linear time and little memory. A plate's memory must depend on its shorter
// side, in either orientation.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// Returns a plate of 3000 by 2 elements that is supported at every tenth line across the plate, and sags
/// onto a stop in each span.
std::string strip(bool along_x) {
  const int lines = 3001;
  const auto node = [&](int along, int across) {
    return std::to_string(1 + (along_x ? across * lines + along : along * 3 + across));
  };
  std::string text = along_x ? "[plate]\nsize = [3000, 2]\nelements = [3000, 2]\n"
                             : "[plate]\nsize = [2, 3000]\nelements = [2, 3000]\n";
  text += "D = 1\nnu = 0.3\n[[support]]\nfix = [\"w\"]\nnodes = [";
  for (int i = 0; i < lines; i += 10) text += node(i, 0) + ", " + node(i, 1) + ", " + node(i, 2) + ", ";
  text += "]\n";
  for (int i = 5; i < lines; i += 500) {
    text += "[[contact]]\nnode = " + node(i, 1) + "\nsurface = \"below\"\nface = -0.01\nstiffness = 100\n";
  }
  return text + "[[step]]\nuniform = -0.001\n";
}

/// Returns a beam with 100,000 explicit nodes, many supports, and stops between some supports.
std::string hundred_thousand_nodes() {
  std::string text = "[beam]\nEI = 1.0\nx = [";
  for (int i = 0; i < 100000; ++i) text += std::to_string(i) + ".0, ";
  text += "]\n[[support]]\nfix = [\"w\"]\nnodes = [";
  for (int i = 1; i <= 100000; i += 9) text += std::to_string(i) + ", ";
  text += "]\n";
  for (int i = 5; i < 100000; i += 9000) {
    text +=
        "[[contact]]\nnode = " + std::to_string(i) + "\nsurface = \"below\"\nface = -0.01\nstiffness = 1.0\n";
  }
  return text + "[[step]]\nuniform = -0.001\n[[step]]\nuniform = 0\n";
}

nlohmann::json result_of(const scratch_folder& dir, const std::string& text, long most_kib) {
  dir.write("large.toml", text);
  const finished f = contct_program(dir.path(), {"run", "large.toml", "--json", "large.json"});
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
#if !defined(__SANITIZE_ADDRESS__)
  CHECK(f.peak_kib < most_kib);
#else
  (void)most_kib;
#endif
  return nlohmann::json::parse(dir.read("large.json"));
}

}  // namespace

TEST_CASE(
    "a run of a plate of 3000 by 2 elements takes under 62 MB, and gives the answer of a plate of 2 by "
    "3000") {
  const scratch_folder dir;
  const auto lying = result_of(dir, strip(true), 62'000);
  const auto standing = result_of(dir, strip(false), 62'000);
  REQUIRE(lying["steps"][0]["w"].size() == 9003);
  CHECK(lying["steps"][0]["elements"].size() == 6000);
  for (int i = 0; i < 6; ++i) {
    const auto& pair = lying["steps"][0]["pairs"][i];
    CHECK(pair["state"] == "contact");
    CHECK(pair["force"].get<double>() ==
          Approx(standing["steps"][0]["pairs"][i]["force"].get<double>()).epsilon(1e-8));
  }
  for (int along = 0; along < 3001; ++along) {
    for (int across = 0; across < 3; ++across) {
      const double a = lying["steps"][0]["w"][across * 3001 + along];
      const double b = standing["steps"][0]["w"][along * 3 + across];
      if (std::abs(a - b) > 1e-9) FAIL("line " << along << ": " << a << " against " << b);
    }
  }
}

TEST_CASE("a run of a plate of 100 by 100 elements takes under 462 MB", "[long]") {
  const scratch_folder dir;
  const auto r = result_of(dir,
                           "[plate]\nsize = [1, 1]\nelements = [100, 100]\nD = 1\nnu = 0.3\n"
                           "[[support]]\nnodes = \"1..101\"\nfix = [\"w\", \"wx\"]\n"
                           "[[support]]\nnodes = \"10101..10201\"\nfix = [\"w\", \"wx\"]\n"
                           "[[step]]\nuniform = -1\n",
                           462'000);
  // The plate has two simply supported and two free edges, so it bends along y with 0.01309 q a^4 / D in the
  // middle.
  CHECK(r["steps"][0]["w"][5100].get<double>() == Approx(-0.01309).epsilon(1e-3));
  CHECK(r["steps"][0]["elements"].size() == 10000);
}

TEST_CASE("a run of a beam of 100,000 nodes takes under 200 MB", "[long]") {
  const scratch_folder dir;
  const auto result = result_of(dir, hundred_thousand_nodes(), 200'000);
  REQUIRE(result["steps"].size() == 2);
  CHECK(result["steps"][0]["w"].size() == 100000);
  CHECK(result["steps"][0]["elements"].size() == 99999);
  int closed = 0;
  for (const auto& pair : result["steps"][0]["pairs"]) closed += pair["state"] == "contact" ? 1 : 0;
  CHECK(closed == 12);
  for (const auto& pair : result["steps"][1]["pairs"]) CHECK(pair["state"] == "separated");
}

TEST_CASE("a run with 200,000 beds of one node each has all their pairs") {
  // Work for every node of every bed would reach the time limit of ctest.
  const scratch_folder dir;
  std::string text = "[beam]\nlength = 200000\nelements = 200000\nEI = 1\n";
  for (int node = 1; node <= 200001; ++node)
    text += "[[bed]]\nmodulus = 1\nface = 0\nnodes = [" + std::to_string(node) + "]\n";
  dir.write("beds.toml", text + "[[step]]\nuniform = -1\n");
  const finished f = contct_program(dir.path(), {"run", "beds.toml", "--kernels", "cpp"});
  INFO(f.err);
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("200001 of 200001 in contact"));
}

TEST_CASE(
    "for a single span of 5,000 elements, contct run warns that about 1 digit of the answer can be relied "
    "on") {
  const scratch_folder dir;
  dir.write("span.toml",
            "[beam]\nlength = 1\nelements = 5000\nEI = 1\n[[support]]\nnodes = [1, 5001]\nfix = [\"w\"]\n"
            "[[step]]\nuniform = -1\n");
  const finished f =
      contct_program(dir.path(), {"run", "span.toml", "--kernels", "fortran,cpp", "--json", "out.json"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.err, Contains("about 1 digit of the answer can be relied on"));
  CHECK(nlohmann::json::parse(dir.read("out.json"))["steps"][0]["digits"].get<int>() <= 2);
}
