// Tests calls beyond the limits of 32-bit integers.
#include "contct/kernel/call.hpp"

#include <limits>

#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

constexpr int least = std::numeric_limits<int>::min();

/// Returns the message about a call with one pair at dof 2 of 2, or "accepted".
std::string verdict(int id, dof_layout layout, int isep, int isurf) {
  const call_inputs<double> in{{0.0, 0.0}, {1.0, 1.0}, {0.5}, {id}, {isep}, {isurf}, layout};
  call_outputs out;
  try {
    refuse_beyond_limits(out.prepare(in), in.isep);
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a call is accepted up to the 32-bit limits of a dof and of the product ISEP * ISURF") {
  CHECK(verdict(2, {1, 1}, 1, -1) == "accepted");
  CHECK(verdict(1, {2, 2}, 65536, -32768) == "accepted");
  CHECK(verdict(2, {1, 1}, 46341, 46340) == "accepted");
  CHECK(verdict(2, {1, 1}, least, 1) == "accepted");
  CHECK(verdict(0, {3, 2}, 1, 1) == "accepted");  // dof 1
}

TEST_CASE("a call is refused if ISEP * ISURF exceeds 32 bits, and the message gives this product") {
  CHECK(verdict(2, {1, 1}, 65536, 65536) ==
        "call: pair 1: found ISEP 65536 and ISURF 65536, whose product is 4294967296; allowed: a product "
        "within 32 "
        "bits, -2147483648 to 2147483647");
  CHECK_THAT(verdict(2, {1, 1}, least, -1), Contains("whose product is 2147483648"));
  CHECK_THAT(verdict(2, {1, 1}, 65536, -32769), Contains("whose product is -2147549184"));
}

TEST_CASE("a call is refused if a dof is outside the arrays, or is inside only after a 32-bit overflow") {
  CHECK(verdict(3, {1, 1}, 1, 1) ==
        "call: pair 1: found ID 3, which is dof 3 with INDOF 1 and NDOFPN 1; allowed: a dof from 1 to 2, "
        "computed "
        "within 32 bits");
  CHECK_THAT(verdict(0, {1, 1}, 1, 1), Contains("found ID 0, which is dof 0"));
  // The dof would be 1 after a 32-bit overflow.
  CHECK_THAT(verdict(65537, {1, 65536}, 1, 1), Contains("which is dof 4294967297"));
  CHECK_THAT(verdict(65537, {-2147483647, 32768}, 1, 1), Contains("which is dof 1 with INDOF -2147483647"));
  CHECK_THAT(verdict(least, {1, 0}, 1, 1), Contains("which is dof 1 with INDOF 1 and NDOFPN 0"));
}

TEST_CASE("a call of 2147483647 pairs is refused at once, because the loop of the listing would not end") {
  const double one = 0.0;
  call<double> c{};
  c.cc = {&one, 2'147'483'647};
  CHECK_THROWS_WITH(refuse_beyond_limits(c, {}), "call: NC: found 2147483647; allowed: 0 to 2147483646");
}
