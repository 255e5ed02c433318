#include "contct/solve/spring_engine.hpp"

#include "catch.hpp"
#include "support/beams.hpp"

using namespace contct::app;

namespace {

/// Records the order in which springs are applied.
class recording_engine final : public spring_engine {
 public:
  explicit recording_engine(const linear_structure& s) : spring_engine(s) {}
  [[nodiscard]] std::string_view name() const override { return "recording"; }
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
  [[nodiscard]] double reciprocal_condition() override { return 1.0; }

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

TEST_CASE("springs that close are applied before those that open, each once") {
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

TEST_CASE("a spring switched there and back is not applied at all") {
  const linear_structure s = with_pairs({false, false, false, false});
  recording_engine e(s);
  e.switch_spring(3, true);
  e.switch_spring(3, false);
  respond(e);
  CHECK(e.order.empty());
}

TEST_CASE("springs closed at the start are wanted, and applied with the first factor") {
  const linear_structure s = with_pairs({true, false, true, false});
  recording_engine e(s);
  e.refused = 1;
  CHECK(e.applied() == std::vector<char>{0, 0, 0, 0});
  e.switch_spring(1, true);
  e.switch_spring(3, true);
  respond(e);
  CHECK_FALSE(e.accepted);
  CHECK(e.order == std::vector<int>{1});  // none after the one that was refused
  CHECK(e.applied() == std::vector<char>{1, 1, 1, 1});
}
