// Frames of a path: the whole structure after its increments, solved for apart from the path.
#include "contct/path/frames.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/structure/problem.hpp"

using namespace contct::app;

namespace {

/// A beam of 8 elements between simple supports over two stops, pressed down and let go of.
struct stopped_beam {
  beam geometry;
  linear_structure structure;
  std::vector<load> steps;

  explicit stopped_beam(const std::vector<double>& uniform) {
    for (int i = 0; i <= 8; ++i) geometry.x.push_back(0.125 * i);
    geometry.EI.assign(8, 1.0);
    structure = build(geometry, std::vector<support>{{0, 0, true, 0.0}, {8, 0, true, 0.0}},
                      {{3, face_below, -0.01, 1e4, false}, {5, face_below, -0.0105, 1e4, false}});
    for (const double q : uniform) steps.push_back({{}, {{{q}, {}}}});
  }
  [[nodiscard]] load_history loads() const {
    return [this](int step, std::span<double> f) {
      add_consistent_loads(geometry, steps[static_cast<std::size_t>(step - 1)], f);
    };
  }
  path_end run(const std::string& leader, frame_keeper& kept) const {
    observer* const observers[] = {&kept};
    return follow_steps(geometry, structure, steps, "refactor", *make_kernel(leader), observers);
  }
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// Remembers what the path itself told at the ends of steps.
class ends final : public observer {
 public:
  void step_ended(const step_state& s) override {
    displacement.emplace_back(s.displacement.begin(), s.displacement.end());
  }
  std::vector<std::vector<double>> displacement;
};

}  // namespace

TEST_CASE("a frame in the middle of a step is the state that a path ends in at that load") {
  for (const std::string leader : {"fortran", "corrected"}) {
    INFO(leader);
    const stopped_beam whole({-10.0, -0.3});
    frame_keeper kept(whole.structure, whole.loads(), leader == "corrected");
    REQUIRE(whole.run(leader, kept).status == path_status::solved);
    REQUIRE(kept.frames().size() == 7);  // the start, two makes and full load, two breaks and full load
    for (const frame& f : kept.frames()) {
      if (f.step != 1) continue;
      INFO("increment " << f.number);
      const stopped_beam part({-10.0 * f.fraction});
      frame_keeper of_part(part.structure, part.loads(), leader == "corrected");
      REQUIRE(part.run(leader, of_part).status == path_status::solved);
      CHECK(largest_difference(f.displacement, of_part.frames().back().displacement) < 1e-12);
      CHECK(f.displacement[8] < -1e-3);
    }
  }
}

TEST_CASE("a frame knows its events, and a pair at its face from one that is pressed") {
  const stopped_beam b({-10.0});
  frame_keeper kept(b.structure, b.loads(), false);
  REQUIRE(b.run("cpp", kept).status == path_status::solved);
  REQUIRE(kept.frames().size() == 4);
  const frame& made = kept.frames()[1];
  CHECK(made.events == std::vector<event>{{0, change::make}});
  CHECK(made.isep == std::vector<int>{in_contact, separated});
  const auto look = [&](const frame& f, std::size_t pair) {
    const contact_pair& p = b.structure.pairs[pair];
    return look_of(p, f.displacement[static_cast<std::size_t>(p.node) * 2], f.closed(pair));
  };
  CHECK(look(made, 0) == pair_state::at_face);
  CHECK(look(made, 1) == pair_state::open);
  CHECK(look(kept.frames()[2], 0) == pair_state::closed);
  CHECK(kept.frames()[3].step_end);
  CHECK_FALSE(kept.frames()[2].step_end);
}

TEST_CASE("the frame at a step's end is the path's own state, to the bit") {
  const stopped_beam b({-10.0, -0.3, -12.0});
  frame_keeper kept(b.structure, b.loads(), false);
  ends told;
  observer* const observers[] = {&kept, &told};
  follow_steps(b.geometry, b.structure, b.steps, "refactor", *make_kernel("fortran"), observers);
  std::size_t step = 0;
  for (const frame& f : kept.frames()) {
    if (f.step_end) CHECK(f.displacement == told.displacement.at(step++));
  }
  CHECK(step == 3);
}

TEST_CASE("a long path is thinned evenly, and its start and its latest state stay") {
  for (int steps = 30; steps < 46; ++steps) {
    INFO(steps << " steps");
    std::vector<double> there_and_back;
    for (int i = 0; i < steps; ++i) there_and_back.push_back(i % 2 == 0 ? -10.0 : -0.3);
    const stopped_beam b(there_and_back);
    frame_keeper kept(b.structure, b.loads(), false, {12, 1'000'000});
    REQUIRE(b.run("cpp", kept).status == path_status::solved);
    CHECK(kept.increments() == 3 * steps);
    CHECK(kept.frames().size() <= 12);
    CHECK(kept.frames().size() >= 4);
    CHECK(kept.frames().front().at == 0);
    CHECK(kept.frames().back().at == 3 * steps);
    CHECK(kept.frames().back().step_end);
    CHECK(std::is_sorted(kept.frames().begin(), kept.frames().end(),
                         [](const frame& x, const frame& y) { return x.at < y.at; }));
  }
}

TEST_CASE("frames of many dofs are fewer, for the memory's sake") {
  const stopped_beam b({-10.0, -0.3, -10.0, -0.3});
  frame_keeper kept(b.structure, b.loads(), false, {100, 90});
  REQUIRE(b.run("cpp", kept).status == path_status::solved);
  CHECK(kept.increments() == 12);
  CHECK(kept.frames().size() <= 5);
  CHECK(kept.frames().back().at == 12);
}

TEST_CASE("what never moved has two frames: the start, and the same as its end") {
  stopped_beam b({-10.0});
  b.structure = build(b.geometry, std::vector<support>{{0, 0, true, 0.0}}, {});
  frame_keeper kept(b.structure, b.loads(), false);
  CHECK(b.run("cpp", kept).status == path_status::mechanism);
  REQUIRE(kept.frames().size() == 2);
  CHECK(kept.frames().back().number == 0);
  CHECK(kept.frames().back().displacement == kept.frames().front().displacement);
}

TEST_CASE("a frame for a picture alone has the digits of one solve, and a step's end still is the path's") {
  const stopped_beam b({-10.0, -0.3});
  frame_limits quick;
  quick.refined = false;
  frame_keeper kept(b.structure, b.loads(), false);
  frame_keeper quickly(b.structure, b.loads(), false, quick);
  ends told;
  observer* const observers[] = {&kept, &quickly, &told};
  (void)follow_steps(b.geometry, b.structure, b.steps, "refactor", *make_kernel("cpp"), observers);
  REQUIRE(kept.frames().size() == quickly.frames().size());
  int others = 0;
  for (std::size_t i = 0; i < kept.frames().size(); ++i) {
    CHECK(largest_difference(kept.frames()[i].displacement, quickly.frames()[i].displacement) < 1e-11);
    others += kept.frames()[i].displacement == quickly.frames()[i].displacement ? 0 : 1;
  }
  CHECK(others > 0);  // frames are refined unless it is said
  CHECK(quickly.frames().back().displacement == told.displacement.back());
}
