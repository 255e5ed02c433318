// An explained run for people. Whole outputs are tested on the program: tests/app/explain_test.cpp.
#include "contct/write/explain_text.hpp"

#include <unistd.h>

#include <cstdio>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "support/scratch_folder.hpp"
#include "write/explained_run.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// What `print` writes to standard output.
template <class Print>
std::string printed(Print print) {
  const scratch_folder folder;
  (void)std::fflush(stdout);
  const int kept = dup(STDOUT_FILENO);
  std::FILE* const file = std::fopen(folder.at("out").c_str(), "w");
  dup2(fileno(file), STDOUT_FILENO);
  print();
  (void)std::fflush(stdout);
  dup2(kept, STDOUT_FILENO);
  close(kept);
  (void)std::fclose(file);
  return folder.read("out");
}

std::string explained(int pair, int width) {
  const problem p = parse_problem(two_pairs, "pb.toml");
  return printed([&] {
    explain_text text(p, {"fortran", "cpp"}, 8, pair, {width, false});
    explain_run(p, [&](const explained_increment& i) { text.print(i); });
  });
}

}  // namespace

TEST_CASE("an explanation has a heading for each increment and each pair, and says when kernels agree") {
  const std::string text = explained(0, 80);
  CHECK_THAT(text, Contains("Step 1, increment 1\n-----"));
  CHECK_THAT(text, Contains("Step 1, increment 2\n"));
  CHECK_THAT(text, Contains("Pair 1, node 2, face below, separated: advancing\n"));
  CHECK_THAT(text, Contains("Pair 2, node 1, face below, separated: no response\n"));
  CHECK_THAT(text, Contains("cpp equal to the bit") && !Contains("DIFFERENT"));
  CHECK_THAT(explained(2, 80), !Contains("Pair 1, node 2"));
}

TEST_CASE("statements of the listing are shown where there is room for them") {
  CHECK_THAT(explained(0, 120), Contains("GAP = CC(I) - DD(NDOF)"));
  CHECK_THAT(explained(0, 119), !Contains("GAP = CC(I)"));
}
