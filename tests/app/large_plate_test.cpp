// Large plates: memory goes with the square of the shorter side, whichever way it lies, and no more.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;

namespace {

/// A strip on line supports at every tenth grid line of its long way, sagging onto a stop in each span.
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

nlohmann::json result_of(const scratch_folder& dir, const std::string& text, long most_kib) {
  dir.write("plate.toml", text);
  const finished f = contct_program(dir.path(), {"run", "plate.toml", "--json", "plate.json"});
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
#if !defined(__SANITIZE_ADDRESS__)
  CHECK(f.peak_kib < most_kib);
#else
  (void)most_kib;
#endif
  return nlohmann::json::parse(dir.read("plate.json"));
}

}  // namespace

TEST_CASE("a plate of 3000 by 2 elements takes under 62 MB, lying or standing, and gives one answer") {
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

TEST_CASE("a plate of 100 by 100 elements takes four bands of 76 MB, two of them the certificate's") {
  const scratch_folder dir;
  const auto r = result_of(dir,
                           "[plate]\nsize = [1, 1]\nelements = [100, 100]\nD = 1\nnu = 0.3\n"
                           "[[support]]\nnodes = \"1..101\"\nfix = [\"w\", \"wx\"]\n"
                           "[[support]]\nnodes = \"10101..10201\"\nfix = [\"w\", \"wx\"]\n"
                           "[[step]]\nuniform = -1\n",
                           462'000);
  // Two edges simply supported, two free: a strip that bends along y, 0.01309 q a^4 / D in the middle.
  CHECK(r["steps"][0]["w"][5100].get<double>() == Approx(-0.01309).epsilon(1e-3));
  CHECK(r["steps"][0]["elements"].size() == 10000);
}
