// Which nodes a table of a problem file names: by their numbers, by coordinates, or by the labels of a
// matrix.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/read/toml_reader.hpp"

namespace contct {

/// Reads the keys that name nodes: node, nodes, and x (beams) or at (plates); dof and dofs on a matrix.
class node_reader {
 public:
  /// `m` must outlive this object.
  explicit node_reader(const model& m);

  /// These keys and `others`, for toml_value::allow_only.
  [[nodiscard]] std::vector<std::string_view> keys_with(std::vector<std::string_view> others) const;

  /// Does a table name nodes?
  [[nodiscard]] bool named_in(const toml_value& t) const { return t.has(key_in(t)); }

  /// The nodes that a table names, from 0, in its order, each once; at least one.
  [[nodiscard]] std::vector<int> read(const toml_value& t) const;

  [[nodiscard]] const model& structure() const { return structure_; }
  [[nodiscard]] bool on_matrix() const { return matrix_ != nullptr; }

  /// The dofs of a matrix that a value names by labels, from 0: one for all of `count`, or one for each.
  [[nodiscard]] std::vector<int> labelled(const toml_value& named, std::size_t count) const;

  /// The dofs of a node that stand as keys in a table, from 0; refuses a table with none.
  [[nodiscard]] std::vector<int> dofs_in(const toml_value& t, std::string_view found) const;

  /// Refuse `named`, which acts on dof `dof` of `node`, where that is one of the two slopes at a hinge.
  void refuse_hinge(const toml_value& named, int node, int dof) const;

  /// The names of a node's dofs.
  [[nodiscard]] const std::vector<std::string_view>& dof_names() const { return dof_names_; }

 private:
  [[nodiscard]] std::string_view key_in(const toml_value& t) const;
  [[nodiscard]] int node_at(const toml_value& named) const;
  [[nodiscard]] int dof_at(const toml_value& named) const;
  [[nodiscard]] std::string labels_allowed() const;

  const model& structure_;
  const assembled* matrix_;                         // null: the structure is a beam or a plate
  std::unordered_map<std::string_view, int> dofs_;  // of a matrix, by label; empty where these are numbers
  std::vector<std::string_view> keys_;              // that for a single node first
  std::vector<std::string_view> dof_names_;         // of a node
};

}  // namespace contct
