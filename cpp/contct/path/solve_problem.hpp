// The path of a structure under load steps that are data, and of a whole problem.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"
#include "contct/structure/structure.hpp"

namespace contct::path {

/// Follow the path of `s`, which was built from `geometry`, through load steps given by their totals,
/// on an engine of its own. add_consistent_loads must know the geometry.
template <class Geometry>
path_end follow_steps(const Geometry& geometry, const linear_structure& s, std::span<const load> steps,
                      std::string_view engine, kernel& leader, std::span<observer* const> observers,
                      const path_limits& limits = {}) {
  const std::unique_ptr<stiffness_engine> solves = make_engine(engine, s);
  const load_history total = [&](int step, std::span<double> f) {
    add_consistent_loads(geometry, steps[step - 1], f);
  };
  return follow_path(s, static_cast<int>(steps.size()), total, *solves, leader, observers, limits);
}

/// The structure that a problem describes.
[[nodiscard]] inline linear_structure structure_of(const problem& p) {
  return build(p.geometry, p.supports, p.pairs);
}

/// The load vectors of a problem's steps. `p` must outlive them.
[[nodiscard]] inline load_history loads_of(const problem& p) {
  return [&p](int step, std::span<double> f) { add_consistent_loads(p.geometry, p.steps[step - 1], f); };
}

/// Follow a problem's path on an engine by name. `s` is its structure.
inline path_end follow(const problem& p, const linear_structure& s, std::string_view engine, kernel& leader,
                       const std::vector<observer*>& observers, const path_limits& limits = {}) {
  return follow_steps(p.geometry, s, p.steps, engine, leader, observers, limits);
}

}  // namespace contct::path
