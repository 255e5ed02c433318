#include <vector>

#include "catch.hpp"
#include "contct/write/table.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

struct end_of_good_problem {
  a_run run{good_problem};
  const frame& last = run.kept.frames().back();
  step_results read = results_of(run.what, load_path(run.what).at(1, 1.0), last.displacement, last.isep,
                                 deflecting_nodes(run.what));
};

}  // namespace

TEST_CASE("The largest of each quantity has a line with its place and its unit") {
  end_of_good_problem e;
  sizes_so_far sizes;
  const std::vector<std::string> lines = largest_lines(e.run.what, e.read, 72, sizes);
  CHECK(lines == std::vector<std::string>{"w             -0.00483721       node 3, x = 2",
                                          "moment        -36.2791          node 1, x = 0",
                                          "contact force 41.8605           pair 1, node 3 below",
                                          "reaction      18.1395           node 1"});
  problem with_units = e.run.what;
  with_units.units = {"m", "kN"};
  CHECK(largest_lines(with_units, e.read, 72, sizes).at(1) ==
        "moment        -36.2791 kN m     node 1, x = 0");
  CHECK(largest_lines(with_units, e.read, 40, sizes).at(1) == "moment -36.2791 kN m, node 1, x = 0");
}

TEST_CASE("The detailed tables have every pair, reaction and end of an element, within 80 columns") {
  end_of_good_problem e;
  const step_state s{1, 1.0, e.last.displacement, e.last.isep, 1.0};
  const std::string text = detail_tables(e.run.what, s, e.read);
  CHECK_THAT(text, Contains("       1          3  below    contact                 0       41.86047"));
  CHECK_THAT(text, Contains("               node  dof                       reaction\n"));
  CHECK_THAT(text, Contains("w                         18.13953"));
  CHECK_THAT(text, Contains("theta                     36.27907"));
  CHECK_THAT(text, Contains("       2  shear") && Contains("          moment"));
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    CHECK(end - at <= 80);
}

TEST_CASE("What is nothing but the rounding of larger numbers before it is printed as 0, without a place") {
  end_of_good_problem e;
  sizes_so_far sizes{{"w", 0.0}, {"moment", 1e15}, {"reaction", 1e10}};
  CHECK(largest_lines(e.run.what, e.read, 72, sizes) ==
        std::vector<std::string>{"w             -0.00483721       node 3, x = 2", "moment        0",
                                 "contact force 41.8605           pair 1, node 3 below",
                                 "reaction      18.1395           node 1"});
}
