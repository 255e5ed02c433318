#include "contct/structure/assembled.hpp"

#include <stdexcept>
#include <utility>

#include "contct/structure/free_motions.hpp"
#include "contct/structure/reactions.hpp"

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

free_motions motions_of(const assembled& a, const linear_structure& s) {
  try {
    return find_free_motions(s.stiffness, a.free_motions);
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(a.name + ": " + e.what());
  }
}

/// Which dofs are lengths, a matrix does not say; those that meet faces are.
std::vector<char> lengths_of(const linear_structure& s) {
  std::vector<char> lengths(static_cast<std::size_t>(s.dofs()), s.pairs.empty() ? 1 : 0);
  for (int i = 0; i < static_cast<int>(s.pairs.size()); ++i)
    lengths[static_cast<std::size_t>(s.dof_of_pair(i))] = 1;
  return lengths;
}

}  // namespace

linear_structure build(const assembled& a, std::span<const support> supports,
                       std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = assembled::dofs_per_node;
  if (a.as_band) s.rows = a.rows;
  if (a.as_band) {
    s.stiffness = band_of(a.stiffness, a.rows);
  } else {
    s.stiffness = columns_of(a.stiffness);
  }
  s.rigid_rows.assign(static_cast<std::size_t>(a.dofs()), rigid_row{});
  put_on_supports(s, supports, std::move(pairs));
  refuse_without_stiffness(a, s);

  // The motions are those that the supports leave: these hold nothing beyond.
  const free_motions motions = motions_of(a, s);
  s.rigid_motions = motions.count;
  s.rigid_rounding = motions.rounding;
  s.held_by_supports.clear();
  s.held_by_pairs.clear();
  for (std::size_t dof = 0; dof < s.fixed.size(); ++dof) {
    const auto row = static_cast<std::size_t>(s.row_of(static_cast<int>(dof)));
    if (s.fixed[dof] == 0) s.rigid_rows[dof] = motions.rows[row];
  }
  for (int i = 0; i < static_cast<int>(s.pairs.size()); ++i)
    s.held_by_pairs.push_back(s.rigid_rows[static_cast<std::size_t>(s.dof_of_pair(i))]);
  s.lengths = lengths_of(s);
  return s;
}

void add_consistent_loads(const assembled& /*a*/, const load& l, std::span<double> f) {
  for (const point_load& p : l.points) f[static_cast<std::size_t>(p.node)] += p.value;
}

std::vector<double> reactions(const assembled& a, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  const std::vector<long double> needs = a.stiffness.times(u);
  return reactions_of(supports, l, u, assembled::dofs_per_node, [&needs](int dof, int /*of_node*/) {
    return static_cast<double>(needs[static_cast<std::size_t>(dof)]);
  });
}

std::vector<double> tributary_shares(const assembled& a) {
  throw std::invalid_argument(a.name + ": a matrix knows no lengths or areas");
}

}  // namespace contct
