#include <stdexcept>
#include <utility>

#include "contct/model/problem.hpp"

namespace contct {
namespace {

void refuse_without_stiffness(const assembled& a, const linear_structure& s) {
  for (int dof = 0; dof < s.dofs(); ++dof) {
    const int row = s.row_of(dof);
    if (s.stiffness.diagonal(row) > 0.0) continue;
    throw std::invalid_argument(a.name + ": dof " + a.label_of(dof) +
                                ": found no stiffness and no support; allowed: a positive entry on the "
                                "diagonal, or a support");
  }
}

}  // namespace

linear_structure build(const assembled& a, std::span<const support> supports,
                       std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = assembled::dofs_per_node;
  if (a.as_band) {
    s.rows = a.rows;
    s.stiffness = band_of(a.stiffness, a.rows);
  } else {
    s.stiffness = columns_of(a.stiffness);
  }
  s.rigid_rows.assign(a.dofs(), rigid_row{});
  put_on_supports(s, supports, std::move(pairs));
  refuse_without_stiffness(a, s);

  // These are the motions that the supports leave free: the supports hold none of them.
  free_motions motions;
  try {
    motions = find_free_motions(s.stiffness, a.free_motions, [&](std::span<const double> in_rows) {
      std::vector<double> u(in_rows.size());
      for (std::size_t dof = 0; dof < u.size(); ++dof)
        u[dof] = s.fixed[dof] != 0 ? 0.0 : in_rows[s.row_of(dof)];
      return a.stiffness.doubt(u);
    });
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(a.name + ": " + e.what());
  }
  s.rigid_motions = motions.count;
  s.rigid_rounding = motions.rounding;
  s.supported_dofs.clear();
  for (std::size_t dof = 0; dof < s.fixed.size(); ++dof)
    if (s.fixed[dof] == 0) s.rigid_rows[dof] = motions.rows[s.row_of(dof)];
  // A matrix does not say which of its dofs are lengths. Those of pairs are; without pairs, all count as
  // such.
  s.lengths.assign(a.dofs(), s.pairs.empty() ? 1 : 0);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) s.lengths[s.dof_of_pair(i)] = 1;
  return s;
}

}  // namespace contct
