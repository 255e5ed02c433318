// Memory, estimated.
#include "contct/exact/demand.hpp"

#include "catch.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::exact;
using contct::read::parse_problem;

namespace {

demand demand_for(const std::string& geometry) {
  return demand_of(parse_problem(geometry + "[[step]]\nuniform = 0.7\n", "p.toml"));
}

}  // namespace

TEST_CASE("the factor of a plate grows with its shorter side, that of a beam with its length") {
  const demand wide = demand_for("[plate]\nsize = [1, 1]\nelements = [40, 10]\nD = 1\nnu = 0.3\n");
  CHECK(wide.dofs == 1353);  // 3 at each of 41 x 11 nodes
  CHECK(wide.band == 38);    // to the next row and one node on
  CHECK(wide.bytes_of_equations() > wide.dofs * (wide.band + 1) * 8);
  CHECK(demand_for("[beam]\nlength = 1\nelements = 100\nEI = 1\n").band == 3);
}

TEST_CASE("what is left of the memory limits the length of numbers") {
  const demand d = demand_for("[beam]\nlength = 1\nelements = 100\nEI = 1\n");
  CHECK(d.bits == 68);  // 4 for each of the 17 digits of a double
  CHECK(d.bits_within(d.bytes_of_equations(), 1000) == 0);
  CHECK(d.bits_within(std::int64_t{1} << 40, 1000) == 1000);
  const std::size_t bits = d.bits_within(d.bytes() * 2, 1 << 19);
  CHECK(bits > static_cast<std::size_t>(d.bits));
  CHECK(d.bytes_of_equations() + d.bytes_of_vectors(static_cast<std::int64_t>(bits)) <= d.bytes() * 2);
  CHECK_THAT(d.words(), Catch::Matchers::Contains("202 dofs by a half bandwidth of 3"));
}
