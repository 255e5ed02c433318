// contct export: what a person at the terminal meets.
#include <string>
#include <vector>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

const std::string gaps = (root / "reference/problems/pb07-three-gap-supports.toml").string();

}  // namespace

TEST_CASE("export writes a deck, and says by what its answers are to be divided") {
  const scratch_folder dir;
  const finished f = contct_program(dir.path(), {"export", gaps, "--calculix", "gaps.inp", "--step", "3"});
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(f.out, Contains("gaps.inp: step 3 of 4, 32 elements, 65 nodes, 3 pairs"));
  CHECK_THAT(f.out, Contains("displacements are ") && Contains(" times the problem's, forces "));
  CHECK(dir.files() == std::vector<std::string>{"gaps.inp"});
  const std::string deck = dir.read("gaps.inp");
  CHECK_THAT(deck, Contains("*STEP,NLGEOM\n") && Contains("*END STEP\n") &&
                       Contains("pair i is the spring to ground node 65 + i"));
  const finished piped = contct_program(dir.path(), {"export", gaps, "--calculix", "-", "--step", "3"});
  CHECK(piped.exit == 0);
  CHECK(piped.out == deck);
}

TEST_CASE("export takes the last step and two elements for one, unless asked otherwise") {
  const scratch_folder dir;
  const finished usual = contct_program(dir.path(), {"export", gaps, "--calculix", "-"});
  const finished same = contct_program(dir.path(), {"export", gaps, "--calculix", "-", "--step", "4",
                                                    "--refine", "2", "--slenderness", "500"});
  CHECK(usual.exit == 0);
  CHECK(usual.out == same.out);
  const finished finer = contct_program(dir.path(), {"export", gaps, "--calculix", "f.inp", "--refine", "4"});
  CHECK_THAT(finer.out, Contains("step 4 of 4, 64 elements, 129 nodes"));
}

TEST_CASE("what export cannot do ends with 2, what was found, what is allowed, and no file") {
  const scratch_folder dir;
  dir.write("free.toml",
            "[beam]\nx = [0, 1, 2]\nEI = 1\n[[bed]]\nmodulus = 1\nface = 0\n[[step]]\nuniform = -1\n");
  const auto refused = [&dir](const std::vector<std::string>& arguments) {
    const finished f = contct_program(dir.path(), arguments);
    CHECK(f.exit == 2);
    CHECK(f.out.empty());
    return f.err;
  };
  CHECK_THAT(refused({"export", gaps, "--calculix", "x.inp", "--step", "5"}),
             Contains("--step: found 5; allowed: 1 to 4"));
  CHECK_THAT(refused({"export", gaps, "--calculix", "x.inp", "--refine", "0"}), Contains("--refine"));
  CHECK_THAT(refused({"export", gaps}), Contains("--calculix"));
  CHECK_THAT(refused({"export", "free.toml", "--calculix", "x.inp"}), Contains("do not hold the structure"));
  CHECK_THAT(refused({"export", "free.toml", "--calculix", "free.toml"}),
             Contains("allowed: a file of its own"));
  CHECK_THAT(refused({"export", (root / "reference/structures/calculix/console.toml").string(), "--calculix",
                      "x.inp"}),
             Contains("only beams and plates"));
  CHECK(dir.files() == std::vector<std::string>{"free.toml"});
}
