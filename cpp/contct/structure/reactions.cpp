#include "contct/structure/reactions.hpp"

#include <set>

namespace contct {

std::vector<double> reactions_of(std::span<const support> supports, const load& l, std::span<const double> u,
                                 int dofs_per_node, const need_of_elements& need) {
  std::vector<double> points(u.size(), 0.0);
  for (const point_load& p : l.points) {
    points[static_cast<std::size_t>(p.node * dofs_per_node + p.dof)] += p.value;
  }
  std::vector<double> values;
  std::set<std::size_t> reacted;
  for (const support& s : supports) {
    const auto dof = static_cast<std::size_t>(s.node * dofs_per_node + s.dof);
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

}  // namespace contct
