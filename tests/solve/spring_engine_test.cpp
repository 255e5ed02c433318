#include "contct/solve/spring_engine.hpp"

#include "catch.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

/// An engine that records the order in which springs are applied.
class recording_engine final : public spring_engine {
 public:
  explicit recording_engine(const linear_structure& s) : spring_engine(s) {}
  void respond(const residual_load& /*residual*/, std::span<double> /*d_star*/) override {
    order.clear();
    accepted = apply_switched([this](int pair) {
      order.push_back(pair);
      return pair != refused;
    });
    if (!accepted) apply_all();
  }
  void recover(std::span<const double> /*load*/, std::span<const double> /*pair_forces*/,
               std::span<double> /*u*/) override {}

  [[nodiscard]] const std::vector<char>& applied() const { return applied_; }
  std::vector<int> order;
  int refused = -1;
  bool accepted = true;
};

linear_structure with_pairs(const std::vector<bool>& closed) {
  beam_problem p{even_beam(1.0, 4, 1.0), {}, {}, {}};
  for (int i = 0; i < 4; ++i) p.pairs.push_back({i, -1, 0.0, 1.0, closed[i]});
  return p.structure();
}

void respond(recording_engine& e) {
  e.respond({{}, 1.0}, {});
}

}  // namespace

TEST_CASE("an engine adds new springs before it removes others, and changes each spring once") {
  const linear_structure s = with_pairs({false, false, false, false});
  recording_engine e(s);
  e.switch_spring(2, true);
  e.switch_spring(0, true);
  respond(e);
  CHECK(e.order == std::vector<int>{2, 0});
  e.switch_spring(2, false);
  e.switch_spring(1, true);
  e.switch_spring(1, true);
  respond(e);
  CHECK(e.order == std::vector<int>{1, 2});
  CHECK(e.applied() == std::vector<char>{1, 1, 0, 0});
  respond(e);
  CHECK(e.order.empty());
}

TEST_CASE(
    "if a spring is switched on and off again before a response, the engine makes no update for the spring") {
  const linear_structure s = with_pairs({false, false, false, false});
  recording_engine e(s);
  e.switch_spring(3, true);
  e.switch_spring(3, false);
  respond(e);
  CHECK(e.order.empty());
}

TEST_CASE("the springs of pairs in contact at the start are in the first factor of an engine") {
  const linear_structure s = with_pairs({true, false, true, false});
  recording_engine e(s);
  e.refused = 1;
  CHECK(e.applied() == std::vector<char>{0, 0, 0, 0});
  e.switch_spring(1, true);
  e.switch_spring(3, true);
  respond(e);
  CHECK_FALSE(e.accepted);
  CHECK(e.order == std::vector<int>{1});  // no spring is applied after the refused spring
  CHECK(e.applied() == std::vector<char>{1, 1, 1, 1});
}

namespace {

constexpr int first_check = 8;

/// Returns the number of responses until a check is due.
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

TEST_CASE("the interval between drift checks doubles up to 128 responses while the drift is negligible") {
  drift_monitor m(first_check);
  for (const int interval : {8, 16, 32, 64, 128, 128}) {
    CHECK(responses_until_due(m) == interval);
    CHECK(m.accepts(of(1e-12)));
  }
}

TEST_CASE("the interval between drift checks is halved down to four responses if the drift is too large") {
  drift_monitor m(first_check);
  for (const int interval : {8, 4, 4}) {
    CHECK(responses_until_due(m) == interval);
    CHECK_FALSE(m.accepts(of(5e-11)));
  }
  CHECK(m.accepts(of(5e-12)));
  CHECK(responses_until_due(m) == 4);
}

TEST_CASE("a check of the drift can be requested for the next response, and its interval can be restarted") {
  drift_monitor m(first_check);
  m.check_next();
  CHECK(m.is_due());
  m.start_interval();
  CHECK(responses_until_due(m) == 8);
}

TEST_CASE("the drift of a response is relative to the largest response of any pair") {
  drift d;
  CHECK(drift_monitor(first_check).accepts(d));
  d.include(-4.0, 0.0);
  d.include(2.0, -4e-11);
  CHECK(drift_monitor(first_check).accepts(d));
  d.include(2.0, -5e-11);
  CHECK_FALSE(drift_monitor(first_check).accepts(d));
}
