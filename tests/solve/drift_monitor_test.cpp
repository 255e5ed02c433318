#include "contct/solve/drift_monitor.hpp"

#include "catch.hpp"

using namespace contct::app;

namespace {

constexpr drift_monitor::limits limits = {8, 32, 1e-2, 1e-3};

/// Responses until a check is due.
int responses_until_due(drift_monitor& m) {
  int count = 1;
  while (!m.is_due()) ++count;
  return count;
}

drift of(double correction) {
  drift d;
  d.include(-1.0, correction);
  return d;
}

}  // namespace

TEST_CASE("the interval doubles while the drift is negligible, up to the longest") {
  drift_monitor m(limits);
  for (const int interval : {8, 16, 32, 32}) {
    CHECK(responses_until_due(m) == interval);
    CHECK(m.accepts(of(1e-4)));
  }
}

TEST_CASE("the interval halves when the drift is too large, down to four, and stays in between") {
  drift_monitor m(limits);
  for (const int interval : {8, 4, 4}) {
    CHECK(responses_until_due(m) == interval);
    CHECK_FALSE(m.accepts(of(0.5)));
  }
  CHECK(m.accepts(of(5e-3)));
  CHECK(responses_until_due(m) == 4);
}

TEST_CASE("drift that a new factor has too is accepted") {
  drift_monitor m(limits);
  CHECK_FALSE(m.accepts(of(0.5)));
  CHECK(m.accepts(of(0.5), 0.6));
}

TEST_CASE("a check can be asked for, and an interval begun again") {
  drift_monitor m(limits);
  m.check_next();
  CHECK(m.is_due());
  m.start_interval();
  CHECK(responses_until_due(m) == 8);
}

TEST_CASE("drift is relative to the largest response, whichever pair has it") {
  drift d;
  CHECK(d.relative() == 0.0);
  d.include(-4.0, 0.0);
  d.include(2.0, -1.0);
  CHECK(d.relative() == 0.25);
}
