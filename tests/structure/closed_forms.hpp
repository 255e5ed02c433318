// Beams of which a closed form is known, and the comparison of their numbers.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/structure/extremes.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

namespace contct {

inline beam bar(std::vector<double> x, double EI, std::vector<int> hinges = {},
                std::vector<double> hinge_stiffness = {}) {
  beam b;
  b.EI.assign(x.size() - 1, EI);
  b.x = std::move(x);
  b.hinges = std::move(hinges);
  b.hinge_stiffness = std::move(hinge_stiffness);
  return b;
}

/// Returns supports that fix w at these nodes, and theta too at the nodes of `clamped`.
inline std::vector<support> held(const std::vector<int>& nodes, const std::vector<int>& clamped = {}) {
  std::vector<support> all;
  for (const int node : nodes) all.push_back({node, 0, true});
  for (const int node : clamped) all.push_back({node, 1, true});
  return all;
}

inline load placed(std::vector<placed_load> all) {
  load l;
  l.placed = std::move(all);
  return l;
}

inline load curved(double curvature, double from, double to) {
  return placed({{load_kind::curvature, from, to, {curvature}}});
}

/// Compares numbers of solved beams with different meshes: u DOF, r SUPPORT, m or v of ELEMENT at END (0 or
/// 1); or the least (<) or the largest (>) w, m or v, or the x of this extreme: "m> xm>". Nodes -1 are the
/// last.
/// `allowed` is relative to the expected number, or absolute for 0, and `x_allowed` is absolute.
inline void check_beams(const char* fact, const std::vector<beam>& beams,
                        const std::vector<support>& supports, const load& l, const std::string& keys,
                        const std::vector<double>& expected, double allowed = 1e-13,
                        double x_allowed = 1e-7) {
  for (const beam& b : beams) {
    std::vector<support> at = supports;
    for (support& s : at)
      if (s.node < 0) s.node += b.nodes();
    const std::vector<double> u = displaced(b, at, l);
    const std::vector<value_range> ranges = ranges_of({b}, l, u, {});
    const element_results forces = results_in_elements(b, l, u);
    const std::vector<double> held = reactions({b}, l, at, u);
    std::istringstream words(keys);
    std::size_t compared = 0;
    for (std::string key; words >> key; ++compared) {
      const bool is_x = key[0] == 'x';
      const char kind = key[is_x ? 1 : 0];
      const std::string rest = key.substr(is_x ? 2 : 1);
      double value = 0.0;
      if (rest == "<" || rest == ">") {
        const value_range& r = ranges.at(kind == 'w' ? 0 : kind == 'm' ? 1 : 2);
        const auto& extreme = rest == "<" ? r.least : r.most;
        value = is_x ? extreme.x : extreme.value;
      } else if (kind == 'u' || kind == 'r') {
        value = (kind == 'u' ? u : held).at(std::stoul(rest));
      } else {
        value = forces.at(std::stoul(rest), kind == 'v' ? 0 : 1)[rest.back() - '0'];
      }
      INFO(fact << ", " << b.elements() << " elements, " << key << ": " << value);
      const double right = expected.at(compared);
      CHECK(value == Approx(right)
                         .epsilon(is_x ? 0 : allowed)
                         .margin(is_x         ? x_allowed
                                 : right == 0 ? allowed
                                              : 0));
    }
    CHECK(compared == expected.size());
  }
}

}  // namespace contct
