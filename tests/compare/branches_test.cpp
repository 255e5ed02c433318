#include "contct/compare/branches.hpp"

#include "catch.hpp"
#include "support/one_pair.hpp"

using namespace contct::app;

TEST_CASE("each IF of the listing is counted by its outcome") {
  small_call<double> c({{0.0, 0.0, 1.0, separated, face_above},     // does not respond
                        {0.0, 1.0, 0.0, in_contact, face_below},    // stationary, pulled: breaks
                        {0.0, -1.0, 0.0, in_contact, face_below},   // stationary, pressed: quiet
                        {0.0, 1.0, -0.5, separated, face_below}});  // moves away
  const std::vector<int> before = c.isep;
  c.ask();
  call<double> answered = c.arguments();
  answered.smin = c.smin;
  branch_counts counts;
  counts.count(answered, before);
  CHECK(counts.of(branch::no_response, true) == 1);
  CHECK(counts.of(branch::no_response, false) == 3);
  CHECK(counts.of(branch::stationary, true) == 2);
  CHECK(counts.of(branch::stationary, false) == 1);
  CHECK(counts.of(branch::check_positive, true) == 1);
  CHECK(counts.of(branch::check_positive, false) == 1);
  CHECK(counts.of(branch::s_positive, true) == 3);
  CHECK(counts.of(branch::s_positive, false) == 1);
  CHECK(counts.of(branch::s_is_smallest, true) == 1);
  CHECK(counts.of(branch::s_is_smallest, false) == 2);
  CHECK(counts.of(branch::no_events, false) == 1);
  CHECK(counts.of(branch::within_epsmul, true) == 1);
  CHECK(counts.of(branch::within_epsmul, false) == 3);
  CHECK(counts.of(branch::was_separated, false) == 1);
  CHECK(counts.rarest() == 0);  // no call without events, no make
}
