// Converts a problem to rational numbers.
#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "contct/exact/path.hpp"

namespace contct {
namespace {

std::vector<added_spring> ground_of(const beam& b) {
  std::vector<added_spring> all;
  for (const int node : b.corners()) all.push_back({beam::dofs_per_node * node, rational(1, 2)});
  return all;
}

std::vector<added_spring> ground_of(const plate& p) {
  std::vector<added_spring> corners;
  for (const int j : {0, p.rows() - 1})
    for (const int i : {0, p.columns() - 1})
      corners.push_back({plate::dofs_per_node * p.node_at(i, j), rational(1, 4)});
  return corners;
}

std::vector<added_spring> ground_of(const assembled& a) {
  std::vector<added_spring> everywhere;
  everywhere.reserve(a.dofs());
  for (int dof = 0; dof < a.dofs(); ++dof) everywhere.push_back({dof, 1});
  return everywhere;
}

}  // namespace

exact_problem exact_problem_of(const problem& p) {
  exact_problem e;
  static_cast<equations<rational>&>(e) = equations_of<rational>(p);
  e.place = rows_in_band(p.geometry);
  if (e.place.empty()) {
    e.place.resize(e.dofs());
    std::iota(e.place.begin(), e.place.end(), 0);
  }
  e.ground = std::visit([](const auto& kind) { return ground_of(kind); }, p.geometry.kind);
  std::erase_if(e.ground, [&e](const added_spring& g) { return e.fixed[g.dof] != 0; });
  for (const load& l : p.steps) e.steps.push_back(e.loads_of(l));
  return e;
}

int subdiagonals(const exact_problem& p) {
  int most = 0;
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    for (const auto& [column, k] : p.stiffness[dof])
      most = std::max(most, std::abs(p.place[dof] - p.place[column]));
  return most;
}

}  // namespace contct
