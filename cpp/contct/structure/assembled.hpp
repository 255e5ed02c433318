// A structure given by its stiffness matrix alone, which another program has assembled.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/matrix/sparse_matrix.hpp"
#include "contct/structure/load.hpp"
#include "contct/structure/placed_nodes.hpp"
#include "contct/structure/structure.hpp"

namespace contct::structure {

/// Every dof is a node of its own here, so that the listing's NDOFPN and INDOF are 1 and its ID the dof.
struct assembled {
  std::string name;                 ///< of the matrix, for messages: its file
  sparse_matrix stiffness;          ///< positive semidefinite
  std::vector<std::string> labels;  ///< [dofs] each once; empty: "1", "2", ...
  std::string labels_from;          ///< the file that has them
  std::vector<int> rows;            ///< [dofs] row of each dof in the band; empty: its own number
  bool as_band = true;              ///< otherwise K is stored by columns, and only CHOLMOD can solve with it
  std::optional<int> free_motions;  ///< how many motions it leaves free on its supports, where that is known
  placed_nodes places;              ///< for pictures only

  static constexpr int dofs_per_node = 1;
  static constexpr std::array<const char*, 1> dof_names = {"value"};
  [[nodiscard]] int nodes() const { return stiffness.order; }
  [[nodiscard]] static int elements() { return 0; }
  [[nodiscard]] int dofs() const { return stiffness.order; }
  [[nodiscard]] std::string label_of(int dof) const {
    return labels.empty() ? std::to_string(dof + 1) : labels[dof];
  }
};

/// Put it on its supports, and find the motions that these leave free: see find_free_motions. Throws
/// std::invalid_argument where a dof without a support has no stiffness, and as find_free_motions does.
[[nodiscard]] linear_structure build(const assembled& a, std::span<const support> supports,
                                     std::vector<contact_pair> pairs);

/// Add the loads of `l`, which are forces at dofs, to `f` [dofs].
void add_consistent_loads(const assembled& a, const load& l, std::span<double> f);

/// The force (or moment) on the structure by each support: see reactions_of.
[[nodiscard]] std::vector<double> reactions(const assembled& a, const load& l,
                                            std::span<const support> supports, std::span<const double> u);

/// Throws std::invalid_argument: a matrix has no lengths or areas.
[[nodiscard]] std::vector<double> tributary_shares(const assembled& a);

}  // namespace contct::structure
