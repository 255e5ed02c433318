// The words for statuses and events, as the formats of reference/ have them.
#include "contct/write/words.hpp"

#include "catch.hpp"

using namespace contct::app;

TEST_CASE("sides, events and states have the words of a problem file") {
  CHECK(surface_name(face_below) == "below");
  CHECK(surface_name(face_above) == "above");
  CHECK(change_name(change::make) == "make");
  CHECK(change_name(change::break_) == "break");
  CHECK(state_name(in_contact) == "contact");
  CHECK(state_name(separated) == "separated");
  CHECK(look_name(pair_look::at_face) == "at its face");
}

TEST_CASE("a path that stops short of its load has one of two statuses, and a reason of its own") {
  CHECK(status_name(path_status::solved) == "solved");
  CHECK(status_name(path_status::mechanism) == "mechanism");
  for (const auto other : {path_status::cycle, path_status::iteration_limit, path_status::not_factored})
    CHECK(status_name(other) == "iteration-limit");
  CHECK(end_reason(path_status::solved) == "all load applied");
  CHECK(end_reason(path_status::cycle) == "cycle");
  CHECK(end_reason(path_status::not_factored) == "not factored");
}
