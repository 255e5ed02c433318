// The summary of an explained run: a line for each increment. That it takes the place of the full text is
// tested in explain_test.cpp.
#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/write/explain.hpp"
#include "write/explained_run.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

namespace {

/// What a summary says of each increment, and at its end.
struct made_summary {
  std::vector<std::string> each;
  std::string end;
};

made_summary summary_of(const std::string& toml, int width = 80) {
  const problem p = parse_problem(toml, "pb.toml");
  const terminal t{width, false};
  made_summary made;
  explain_run(p, [&](const explained_increment& i) { made.each.push_back(summary_line(t, i)); });
  made.each.at(0) = summary_head(t, p.title) + made.each[0];
  made.end = summary_end(t, made.each.size());
  return made;
}

}  // namespace

TEST_CASE("title and columns stand above the first line of a summary only") {
  const made_summary made = summary_of(std::string("title = \"A stop\"\n") + two_pairs);
  CHECK(made.each == std::vector<std::string>{
                         "A stop\n  incr  share      events\n   1.1  0.25       make 1\n",
                         "   1.2  1          no event\n",
                     });
}

TEST_CASE("a summary ends with the number of increments and what explains one") {
  CHECK_THAT(summary_of(two_pairs).end, Contains("\n2 increments; share: share of the step applied so far") &&
                                            Contains("--increment STEP.INCREMENT") && EndsWith("--all\n"));
}

TEST_CASE("a summary names the pairs that are toggled too early") {
  CHECK_THAT(summary_of("[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
                        "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.25\nstiffness = 1\n"
                        "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.2501\nstiffness = 1\n"
                        "[[step]]\npoint = [ { node = 2, w = -3 } ]\n")
                 .each.at(0),
             EndsWith("   1.1  0.25       make 1, make 2; too early: 2\n"));
}

TEST_CASE("of more than twelve events a summary counts the rest, and breaks its line at the width") {
  std::string toml = "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
  for (int i = 0; i < 15; ++i)
    toml += "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.25\nstiffness = 1\n";
  const std::string first = summary_of(toml + "[[step]]\npoint = [ { node = 2, w = -3 } ]\n", 60).each.at(0);
  CHECK_THAT(first, Contains("make 12, 3 more\n") && Contains("\n                   make"));
  CHECK_THAT(first, !Contains("make 13"));
}
