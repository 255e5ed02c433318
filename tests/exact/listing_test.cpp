// One call of the listing in rational numbers.
#include "contct/exact/listing.hpp"

#include "catch.hpp"
#include "contct/kernel/call.hpp"

using namespace contct::exact;

namespace {

listing_pair open_pair(const rational& c, const rational& d, const rational& d_star) {
  return {c, d, d_star, false, face_below};
}

rational ten_to_minus(unsigned n) {
  return {integer(1), boost::multiprecision::pow(integer(10), n)};
}

}  // namespace

TEST_CASE("each way to an s gives the exact one") {
  const rational d_star(-1, 3);
  const std::vector<listing_pair> pairs = {
      open_pair(-1, 0, 0),                // no response
      open_pair(rational(-1, 7), 0, -1),  // advancing
      open_pair(0, 0, d_star),            // at its face, pushed against it
      {0, 0, d_star, true, face_below},   // at its face, kept there
  };
  const listing_answer a = answer_exactly(pairs);
  CHECK(a.s == vector{1, rational(1, 7), 3 * ten_to_minus(20), 1});
  CHECK(a.way == std::vector{way_to_s::no_response, way_to_s::moving, way_to_s::stationary_event,
                             way_to_s::stationary});
  CHECK(a.s_min == 3 * ten_to_minus(20));
  CHECK(a.toggled == std::vector<int>{2});
  CHECK(a.winners() == std::vector<int>{2});
}

TEST_CASE("a gap of exactly EPSGAP is not stationary, and an s of exactly 1 is no event") {
  const std::vector<listing_pair> pairs = {open_pair(-ten_to_minus(10), 0, -ten_to_minus(10))};
  const listing_answer a = answer_exactly(pairs);
  CHECK(a.way[0] == way_to_s::moving);
  CHECK(a.s_min == 1);
  CHECK(a.toggled.empty());
  CHECK(a.winners().empty());
}

TEST_CASE("whatever is within EPSMUL is toggled, but only a tie wins together") {
  const std::vector<listing_pair> pairs = {
      open_pair(rational(-1, 2), 0, -1), open_pair(-2, -1, -2),
      open_pair(rational(-1, 2) - rational(1, 1024), 0, -1),  // 1/512 later: within 1/256
      open_pair(rational(-1, 2) - rational(1, 512), 0, -1),   // exactly 1/256 later
  };
  const listing_answer a = answer_exactly(pairs);
  CHECK(a.winners() == std::vector<int>{0, 1});
  CHECK(a.toggled == std::vector<int>{0, 1, 2});
}
