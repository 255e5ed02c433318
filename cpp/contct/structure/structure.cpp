#include "contct/structure/structure.hpp"

#include <algorithm>
#include <utility>

namespace contct {
namespace {

/// A fixed dof keeps its place: its row and column become those of the identity.
void fix(band_matrix& k, int row) {
  const int last = std::min(k.order() - 1, row + k.subdiagonals());
  for (int i = std::max(0, row - k.subdiagonals()); i <= last; ++i) {
    k.at(std::max(i, row), std::min(i, row)) = i == row ? 1.0 : 0.0;
  }
}

}  // namespace

void put_on_supports(linear_structure& s, std::span<const support> supports,
                     std::vector<contact_pair> pairs) {
  s.fixed.assign(static_cast<std::size_t>(s.dofs()), 0);
  for (const support& p : supports) {
    const int dof = p.node * s.dofs_per_node + p.dof;
    if (p.fixed) {
      s.fixed[static_cast<std::size_t>(dof)] = 1;
    } else {
      s.stiffness.add(s.row_of(dof), s.row_of(dof), p.spring);
    }
    s.held_by_supports.push_back(s.rigid_rows[static_cast<std::size_t>(dof)]);
  }
  for (int dof = 0; dof < s.dofs(); ++dof) {
    if (s.fixed[static_cast<std::size_t>(dof)] != 0) fix(s.stiffness, s.row_of(dof));
  }
  s.pairs = std::move(pairs);
  for (int i = 0; i < static_cast<int>(s.pairs.size()); ++i) {
    s.held_by_pairs.push_back(s.rigid_rows[static_cast<std::size_t>(s.dof_of_pair(i))]);
  }
}

}  // namespace contct
