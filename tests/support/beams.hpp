// Small beams with pairs, for tests of paths.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contct/kernel/registry.hpp"
#include "contct/model/problem.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct {

/// A beam problem in memory, and its run.
struct beam_problem {
  beam geometry;
  std::vector<support> supports;
  std::vector<contact_pair> pairs;
  std::vector<load> steps;

  [[nodiscard]] linear_structure structure() const { return build(geometry, supports, pairs); }
  [[nodiscard]] problem as_problem() const {
    problem p;
    p.geometry.kind = geometry;
    p.supports = supports;
    p.pairs = pairs;
    p.steps = steps;
    return p;
  }

  path_end run(kernel& k, const std::vector<observer*>& observers, const path_limits& limits = {}) const {
    return follow(as_problem(), structure(), "refactor", k, observers, limits);
  }

  path_end run(const std::string& kernel_name, const std::vector<observer*>& observers,
               const path_limits& limits = {}) const {
    return run(*make_kernel(kernel_name), observers, limits);
  }
};

/// Copies the numbers and events that an observer receives.
struct recorder final : observer {
  struct seen_increment {
    int step, number;
    double s, fraction;
    std::vector<event> events;
    bool snaps;
  };
  struct seen_step {
    int step;
    double fraction;
    std::vector<double> u;
    std::vector<int> isep;
    double rcond;
    bool from_fallback;
  };
  std::vector<seen_increment> increments;
  std::vector<seen_step> steps;
  std::string text;

  void called(const answered_call& c) override { text += c.text.value_or(""); }
  void incremented(const increment& i) override {
    increments.push_back({i.step, i.number, i.s, i.fraction, {i.events.begin(), i.events.end()}, i.snaps});
  }
  void step_ended(const step_state& s) override {
    steps.push_back({s.step,
                     s.fraction,
                     {s.displacement.begin(), s.displacement.end()},
                     {s.isep.begin(), s.isep.end()},
                     s.rcond,
                     s.from_fallback});
  }
  /// Returns all events of the path in order.
  [[nodiscard]] std::vector<event> events() const {
    std::vector<event> all;
    for (const auto& i : increments) all.insert(all.end(), i.events.begin(), i.events.end());
    return all;
  }
};

inline beam even_beam(double length, int elements, double EI) {
  beam b;
  for (int i = 0; i <= elements; ++i) b.x.push_back(length * i / elements);
  b.EI.assign(static_cast<std::size_t>(elements), EI);
  return b;
}

inline load tip_load(int node, double w) {
  return {{{node, 0, w}}, {}};
}

/// Returns PB1: a cantilever over a stop at its tip, which is loaded, unloaded and loaded upwards.
inline beam_problem cantilever_over_a_stop() {
  return {even_beam(2.0, 2, 1e4),
          {{0, 0, true}, {0, 1, true}},
          {{2, -1, -0.004, 5e4, false}},
          {tip_load(2, -10), tip_load(2, -60), tip_load(2, -30), tip_load(2, 20)}};
}

/// Returns a free beam on a spring at each node, with all pairs in contact.
inline beam_problem free_beam_on_springs(double length, int elements, double EI, double modulus) {
  beam_problem p{even_beam(length, elements, EI), {}, {}, {}};
  const auto lengths = tributary_shares(p.geometry);
  for (int i = 0; i <= elements; ++i)
    p.pairs.push_back({i, -1, 0.0, modulus * lengths[static_cast<std::size_t>(i)], true});
  return p;
}

}  // namespace contct
