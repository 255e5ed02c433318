// The mesh of a structure from elsewhere, as the page draws it where its nodes have places.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "contct/write/finished_run.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/page_sampling.hpp"

namespace contct::write {

/// The mesh as the page numbers it: the nodes shown, from 0. All arguments must outlive it.
class mesh_page {
 public:
  mesh_page(const assembled& a, const shown_parts& shown);

  /// "names" and places of the nodes, "edges" between them, by their numbers, two by two; the "axes" that
  /// displacements have, the "unit" these are given in, and the largest of them, "reach"; "still": nodes
  /// without a dof; the "views" there are, and which "view" shows most.
  [[nodiscard]] nlohmann::ordered_json geometry() const;

  /// The displacements of all nodes along the axes, as whole numbers of units.
  [[nodiscard]] nlohmann::ordered_json displacements(const frame& f) const;

  /// The largest loads of those that can be drawn: [node, direction, dof, value, label].
  [[nodiscard]] nlohmann::ordered_json points(const load& l) const;

  /// Add "at" which node a dof is and in which "direction", 1 to 6; null and 0 where that is not shown.
  void place(int dof, nlohmann::ordered_json& entry) const;

 private:
  /// The node of a dof on the page; -1 where it is not there.
  [[nodiscard]] int node_of(int dof) const;
  [[nodiscard]] double unit() const;

  const assembled& structure_;
  const placed_nodes& places_;
  const shown_parts& shown_;
  std::vector<dofs_of_node> of_node_;
  std::vector<int> axes_;
  std::vector<int> number_;  // of a node on the page; -1: it is not there
};

}  // namespace contct::write
