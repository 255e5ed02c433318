// Recorded text, compared by bytes or by meaning. No f2c is needed for its traces.
#include "contct/compare/replay.hpp"

#include "catch.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;

namespace {

/// One pair with an event half way, as `kernel` is said to have answered it, with that scale factor in its
/// text.
std::string trace_of(const std::string& kernel, const std::string& scale_factor) {
  const call_inputs<double> in{{0.0}, {1.0}, {0.5}, {1}, {separated}, {face_above}, {}};
  const double ss[] = {0.5};
  const int isep[] = {in_contact};
  trace_header header;
  header.kernel = kernel;
  std::string text;
  append_header(header, text);
  append_inputs(1, "", in, text);
  append_answer(0.5, ss, isep,
                "  ******* MAKING CONTACT ********\n"
                "   CONTACT PAIR:   1 NODE:   1 SURFACE:   1 SCALE FACTOR = " +
                    scale_factor + "\n",
                text);
  return text;
}

replay_report replayed(const std::string& trace) {
  trace_reader calls(trace, "a.trace");
  const trace_header h = calls.read_header();
  return replay(h, calls, *make_kernel("cpp"));
}

}  // namespace

TEST_CASE("the text of a trace is compared by bytes, and that of f2c's by meaning") {
  CHECK(replayed(trace_of("fortran", " 0.5000E+00")).compared.mismatches == 0);
  CHECK(replayed(trace_of("f2c", "  .5000E+00")).compared.mismatches == 0);
  const replay_report dropped = replayed(trace_of("fortran", "  .5000E+00"));
  CHECK(dropped.compared.mismatches == 1);
  REQUIRE(dropped.first);
  CHECK(dropped.first->where.field == "text");
}

TEST_CASE("a trace that names f2c has to mean the same number") {
  CHECK(replayed(trace_of("f2c", "  .5001E+00")).compared.mismatches == 1);
  CHECK(replayed(trace_of("f2c", "  .5000E+01")).compared.mismatches == 1);
}

TEST_CASE("a trace that names a kernel which is not known here is compared by bytes") {
  CHECK(replayed(trace_of("another", " 0.5000E+00")).compared.mismatches == 0);
  CHECK(replayed(trace_of("another", "  .5000E+00")).compared.mismatches == 1);
}
