// Small beams with pairs, for tests of paths.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/structure/problem.hpp"

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

  solved_path run(kernel& k, const std::vector<observer*>& observers, int max_increments = 0) const {
    return follow(as_problem(), structure(), "refactor", k, observers, nullptr, max_increments);
  }

  solved_path run(const std::string& kernel_name, const std::vector<observer*>& observers) const {
    return run(*make_kernel(kernel_name), observers);
  }
};

/// Copies the numbers and events that an observer receives, and the ends of steps.
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
    origin from;
  };
  std::vector<seen_increment> increments;
  std::vector<seen_step> steps;
  std::string text;

  void called(const answered_call& c) override { text += c.text.value_or(""); }
  void incremented(const increment& i) override {
    increments.push_back({i.step, i.number, i.s, i.fraction, {i.events.begin(), i.events.end()}, i.snaps});
  }
  void take(const solved_path& path) {
    for (const solved_step& s : path.steps)
      steps.push_back({s.step, s.fraction, s.displacement, s.isep, s.rcond, s.from});
  }
  /// Returns all events of the path in order.
  [[nodiscard]] std::vector<event> events() const {
    std::vector<event> all;
    for (const auto& i : increments) all.insert(all.end(), i.events.begin(), i.events.end());
    return all;
  }
};

/// A path, and what an observer received of it.
struct seen_path {
  path_end end;
  recorder seen;
};
template <class Kernel>
seen_path path_of(const beam_problem& p, Kernel&& kernel) {
  seen_path r;
  const solved_path path = p.run(kernel, {&r.seen});
  r.end = path.end;
  r.seen.take(path);
  return r;
}

inline beam even_beam(double length, int elements, double EI) {
  beam b;
  for (int i = 0; i <= elements; ++i) b.x.push_back(length * i / elements);
  b.EI.assign(static_cast<std::size_t>(elements), EI);
  return b;
}

inline load tip_load(int node, double w) {
  return {{{node, 0, w}}, {}};
}

inline load uniform(double q, std::vector<int> elements = {}) {
  return {{}, {{{q}, std::move(elements)}}};
}

/// Returns a cantilever of two elements of length 1.
inline beam_problem cantilever(std::vector<contact_pair> pairs, std::vector<load> steps) {
  return {even_beam(2.0, 2, 1e4), {{0, 0, true}, {0, 1, true}}, std::move(pairs), std::move(steps)};
}

/// Returns PB1: a cantilever over a stop at its tip, which is loaded, unloaded and loaded upwards.
inline beam_problem cantilever_over_a_stop() {
  return cantilever({{2, -1, -0.004, 5e4, false}},
                    {tip_load(2, -10), tip_load(2, -60), tip_load(2, -30), tip_load(2, 20)});
}

/// Returns a beam without supports, of four elements of length 1.
inline beam_problem free_beam(double EI, std::vector<contact_pair> pairs, std::vector<load> steps) {
  return {even_beam(4.0, 4, EI), {}, std::move(pairs), std::move(steps)};
}

/// Returns a free beam above stops at its ends, at distances of 0.1 and 0.3.
inline beam_problem beam_above_stops(std::vector<load> steps) {
  return free_beam(1e3, {{0, -1, -0.1, 50.0, false}, {4, -1, -0.3, 50.0, false}}, std::move(steps));
}

/// Returns a free beam that balances on a pair in its middle, above a stop that it does not reach.
inline beam_problem balanced_beam(std::vector<load> steps) {
  return free_beam(1e3, {{2, -1, -0.1, 50.0, false}, {0, -1, -9, 1e3, false}}, std::move(steps));
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
