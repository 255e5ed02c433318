// Tests the trace of a found mismatch. app/fuzz_test.cpp tests the result of a fuzz run.
#include "catch.hpp"
#include "contct/lab/fuzz.hpp"
#include "contct/lab/random_calls.hpp"

using namespace contct;

namespace {

/// Returns a found mismatch in one adversarial call with at least three pairs.
found_case a_case() {
  call_source source(1989, 8);
  std::uint64_t number = 2;
  while (source.at(number).pairs() < 3) number += 2;
  found_case c;
  c.what = {1, "fortran", "mine", {"SS", 1, "0x1p+0", "0x1p-1", 1}, {}};
  c.calls = {source.at(number)};
  c.leader.resize(1);
  c.leader[0].smin = 0.5;
  c.leader[0].ss.assign(c.calls[0].pairs(), 0.5);
  c.leader[0].isep = c.calls[0].isep;
  return c;
}

}  // namespace

TEST_CASE("contct fuzz writes a shrunk case as a trace, and the header of the trace says what differed") {
  const found_case c = a_case();
  const std::string text = trace_of(c, {});
  trace_reader reader(text, "a case");
  const trace_header h = reader.read_header();
  REQUIRE_FALSE(h.about.empty());
  CHECK(h.about[0] == "call 1: mine differs in SS(1): fortran has 0x1p+0 = 1, mine has 0x1p-1 = 0.5 (1 ULP)");
  recorded_call read;
  REQUIRE(reader.next(read));
  CHECK(read.in.id == c.calls[0].id);
  CHECK(read.out.ss == c.leader[0].ss);
  CHECK_FALSE(reader.next(read));
}
