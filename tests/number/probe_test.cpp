#include "contct/number/probe.hpp"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <cfenv>

#include "catch.hpp"

using namespace contct;

TEST_CASE("the floating-point probe finds this build strict") {
  const floating_point found = probe_floating_point();
  INFO(describe(found));
  CHECK(found.strict());
  CHECK(describe(found) == "strict");
}

TEST_CASE("the floating-point probe detects any rounding mode other than to nearest") {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const floating_point found = probe_floating_point();
    std::fesetround(FE_TONEAREST);
    CHECK_FALSE(found.rounds_to_nearest);
    CHECK_FALSE(found.strict());
    CHECK(describe(found).find("rounding mode") != std::string::npos);
  }
}

#ifdef __SSE2__
TEST_CASE("the floating-point probe detects that subnormals are flushed to zero") {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8000);  // FTZ
  const floating_point flushed = probe_floating_point();
  _mm_setcsr(before | 0x0040);  // DAZ
  const floating_point zeroed = probe_floating_point();
  _mm_setcsr(before);
  CHECK(flushed.flushes_results);
  CHECK_FALSE(flushed.flushes_operands);
  CHECK(zeroed.flushes_operands);
  CHECK(probe_floating_point().strict());
}
#endif
