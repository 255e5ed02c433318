// CalculiX's answers come back whole, or not at all.
#include "peer/calculix_results.hpp"

#include <string>
#include <vector>

#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// As CalculiX 2.20 wrote it.
const std::string captured =
    "\n displacements (vx,vy,vz) for set GIVEN and time  0.1000000E+01\n\n"
    "         1  0.000000E+00  0.000000E+00  0.000000E+00\n"
    "         2  6.291526E-20 -1.043049E-19 -1.511678E-10\n"
    "         3  3.037358E-19  0.000000E+00 -4.837226E-10\n"
    "\n forces (fx,fy,fz) for set GROUND and time  0.1000000E+01\n\n"
    "        18  0.000000E+00  0.000000E+00  4.186131E-06\n";

std::string with(std::string_view from, std::string_view to) {
  std::string text = captured;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// What parsing `text` is refused with; empty when it is not.
std::string refusal(const std::string& text) {
  try {
    (void)parse_calculix_dat(text, "job.dat");
  } catch (const input_error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a table of CalculiX gives its quantity, set, time and every node") {
  const std::vector<calculix_table> tables = parse_calculix_dat(captured, "job.dat");
  REQUIRE(tables.size() == 2);
  CHECK(tables[0].quantity == "displacements");
  CHECK(tables[0].set == "GIVEN");
  CHECK(tables[0].time == 1.0);
  CHECK(tables[0].at.size() == 3);
  CHECK(tables[0].at.at(2) == std::array<double, 3>{6.291526e-20, -1.043049e-19, -1.511678e-10});
  CHECK(tables[1].quantity == "forces");
  CHECK(tables[1].at.at(18)[2] == 4.186131e-06);
}

TEST_CASE("an exponent of three digits, which Fortran writes without E, is read") {
  const std::vector<calculix_table> tables =
      parse_calculix_dat(with("6.291526E-20", "6.291526-120"), "job.dat");
  CHECK(tables[0].at.at(2)[0] == 6.291526e-120);
}

TEST_CASE("what CalculiX does not write is refused with its line") {
  CHECK(refusal(captured).empty());
  CHECK_THAT(refusal(with("-1.511678E-10", "NaN")),
             Contains("job.dat:5: found") && Contains("three finite numbers"));
  CHECK_THAT(refusal(with("-1.511678E-10", "")), Contains("job.dat:5: "));
  CHECK_THAT(refusal(with("-1.511678E-10", "-1.511678E-10 1")), Contains("job.dat:5: "));
  CHECK_THAT(refusal(with("-1.511678E-10", "-1.51x")), Contains("job.dat:5: "));
  CHECK_THAT(refusal(with("         3 ", "         2 ")),
             Contains("job.dat:6: ") && Contains("each node once"));
  CHECK_THAT(refusal(with("         3 ", "9999999999 ")), Contains("job.dat:6: "));
  CHECK_THAT(refusal(with("displacements", "stresses")), Contains("job.dat:2: ") && Contains("for set NAME"));
  CHECK_THAT(refusal(with("for set GIVEN", "set GIVEN")), Contains("job.dat:2: "));
  CHECK_THAT(refusal(with("time  0.1", "time  x.1")), Contains("job.dat:2: "));
  CHECK_THAT(refusal("         3  3.037358E-19  0.000000E+00 -4.837226E-10\n"), Contains("job.dat:1: "));
  CHECK_THAT(refusal(captured.substr(0, captured.size() - 1)),
             Contains("job.dat:10: ") && Contains("cut short"));
  CHECK_THAT(refusal(captured.substr(0, captured.find("        18"))), Contains("found no node"));
  CHECK_THAT(refusal(" forces (fx,fy,fz) for set \007\033 and time 1\n"), Contains("for set \"\\x07\\x1b\""));
}

TEST_CASE("every cut of a file is refused, or the nodes it lacks are missed") {
  for (std::size_t n = 0; n + 1 < captured.size(); ++n) {
    const std::string text = captured.substr(0, n);
    INFO("the first " << n << " characters");
    const auto both = [&text] {
      const std::vector<calculix_table> tables = parse_calculix_dat(text, "job.dat");
      (void)values_at_end(tables, "displacements", "GIVEN", 1, 3, "job.dat");
      (void)values_at_end(tables, "forces", "GROUND", 18, 1, "job.dat");
    };
    CHECK_THROWS_AS(both(), input_error);
  }
}

TEST_CASE("the values at the end are those at time 1, and all of them") {
  const std::vector<calculix_table> tables =
      parse_calculix_dat(with("0.1000000E+01", "0.2500000E+00") + captured, "job.dat");
  REQUIRE(tables.size() == 4);
  const auto u = values_at_end(tables, "displacements", "GIVEN", 1, 3, "job.dat");
  REQUIRE(u.size() == 3);
  CHECK(u[2][2] == -4.837226e-10);
  CHECK_THROWS_WITH(values_at_end(tables, "displacements", "GIVEN", 1, 4, "job.dat"), Contains("node 4"));
  CHECK_THROWS_WITH(values_at_end(tables, "forces", "GIVEN", 1, 3, "job.dat"), Contains("found no forces"));
  const auto early =
      parse_calculix_dat(with("GIVEN and time  0.1000000E+01", "GIVEN and time  0.9000000E+00"), "job.dat");
  CHECK_THROWS_WITH(values_at_end(early, "displacements", "GIVEN", 1, 3, "job.dat"),
                    Contains("did not reach"));
}
