// Tests the trace of a found mismatch. app/commands_test.cpp tests the result of a fuzz run.
#include "catch.hpp"
#include "contct/harness/fuzz.hpp"

using namespace contct;

TEST_CASE("contct fuzz writes a shrunk case as a trace, and the header of the trace says what differed") {
  found_case c;
  c.what = {1, "fortran", "mine", {"SS", 1, "0x1p+0", "0x1p-1", 1}, {}};
  c.calls = {
      {1,
       "",
       {{0.0, 0.5}, {1.0, 2.0}, {0.5, 4.0}, {2, 1}, {separated, in_contact}, {face_above, face_below}, {}},
       {0.5, {0.25, 0.5}, {separated, separated}, ""}}};
  const std::string text = trace_of(c, {});
  trace_reader reader(text, "a case");
  const trace_header h = reader.read_header();
  REQUIRE_FALSE(h.about.empty());
  CHECK(h.about[0] == "call 1: mine differs in SS(1): fortran has 0x1p+0 = 1, mine has 0x1p-1 = 0.5 (1 ULP)");
  recorded_call read;
  REQUIRE(reader.next(read));
  CHECK(read.in.id == c.calls[0].in.id);
  CHECK(read.out.ss == c.calls[0].out.ss);
  CHECK_FALSE(reader.next(read));
}
