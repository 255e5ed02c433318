#include "contct/structure/structure.hpp"

#include <utility>

namespace contct {
void put_on_supports(linear_structure& s, std::span<const support> supports,
                     std::vector<contact_pair> pairs) {
  s.fixed.assign(static_cast<std::size_t>(s.dofs()), 0);
  for (const support& p : supports) {
    const int dof = p.node * s.dofs_per_node + p.dof;
    if (p.fixed) {
      s.fixed[static_cast<std::size_t>(dof)] = 1;
    } else {
      s.stiffness.add_to_diagonal(s.row_of(dof), p.spring);
    }
    s.held_by_supports.push_back(s.rigid_rows[static_cast<std::size_t>(dof)]);
  }
  std::vector<char> fixed_rows(s.fixed.size(), 0);
  for (int dof = 0; dof < s.dofs(); ++dof)
    fixed_rows[static_cast<std::size_t>(s.row_of(dof))] = s.fixed[static_cast<std::size_t>(dof)];
  s.stiffness.fix(fixed_rows);
  s.pairs = std::move(pairs);
  for (int i = 0; i < static_cast<int>(s.pairs.size()); ++i) {
    s.held_by_pairs.push_back(s.rigid_rows[static_cast<std::size_t>(s.dof_of_pair(i))]);
  }
}

}  // namespace contct
