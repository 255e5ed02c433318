#include "contct/structure/structure.hpp"

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace contct::structure {

void add_to_band(band_matrix& k, int row, int column, double entry, int element) {
  if (!std::isfinite(entry))
    throw std::invalid_argument("the stiffness of element " + std::to_string(element + 1) +
                                " is not a finite number");
  k.add(row, column, entry);
}

void put_on_supports(linear_structure& s, std::span<const support> supports,
                     std::vector<contact_pair> pairs) {
  s.fixed.assign(s.dofs(), 0);
  for (const support& p : supports) {
    const int dof = p.node * s.dofs_per_node + p.dof;
    if (p.fixed) {
      s.fixed[dof] = 1;
    } else {
      s.stiffness.add_to_diagonal(s.row_of(dof), p.spring);
    }
    s.held_by_supports.push_back(s.rigid_rows[dof]);
  }
  std::vector<char> fixed_rows(s.fixed.size(), 0);
  for (int dof = 0; dof < s.dofs(); ++dof) fixed_rows[s.row_of(dof)] = s.fixed[dof];
  s.stiffness.fix(fixed_rows);
  s.pairs = std::move(pairs);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) s.held_by_pairs.push_back(s.rigid_rows[s.dof_of_pair(i)]);
}

std::vector<double> reactions_of(std::span<const support> supports, const load& l, std::span<const double> u,
                                 int dofs_per_node, const need_of_elements& need) {
  std::vector<double> points(u.size(), 0.0);
  add_point_loads(l, dofs_per_node, points);
  std::vector<double> values;
  std::set<int> reacted;
  for (const support& s : supports) {
    const int dof = s.node * dofs_per_node + s.dof;
    if (!s.fixed) {
      values.push_back(-s.spring * u[dof]);
    } else if (reacted.insert(dof).second) {
      values.push_back(need(s.node, s.dof) - points[dof]);
    } else {
      values.push_back(0.0);
    }
  }
  return values;
}

}  // namespace contct::structure
