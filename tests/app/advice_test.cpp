// Tests the advice that a run prints if its states are not certified.
#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

TEST_CASE(
    "if a spring is too stiff, contct run names the spring as the cause and suggests a stiffness that is "
    "certified") {
  const scratch_folder dir;
  const std::string file = "reference/problems/pb01-cantilever-tip-stop.toml";
  std::filesystem::copy(root / file, dir.path() / "pb1.toml");
  std::string text = dir.read("pb1.toml");
  const auto with_stiffness = [&](const std::string& stiffness) {
    std::string changed = text;
    dir.write("own.toml", changed.replace(changed.find("5.0e4"), 5, stiffness));
    return contct_program(dir.path(), {"run", "own.toml", "--kernels", "corrected", "--strict"});
  };
  // The beam's stiffness for w of the tip is 12 EI / h^3 = 1.2e5.
  const finished f = with_stiffness("1e30");
  CHECK(f.exit == 3);
  CHECK_THAT(f.err, Contains("the stiffness 1e+30 of pair 1 (node 3, below), 8e+24 times") &&
                        Contains("the largest useful stiffness is 1e+13", Catch::CaseSensitive::No));
  const finished better = with_stiffness("1e13");
  CHECK(better.exit == 0);
  CHECK(better.err.empty());
}
