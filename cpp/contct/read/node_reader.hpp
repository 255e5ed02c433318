// Which nodes a table of a problem file names: by their numbers, by coordinates, or by the labels of a
// matrix; and the nodes of a beam whose elements have a largest length.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/read/toml_reader.hpp"

namespace contct {

inline constexpr int most_elements = 2'000'000;

/// Which of the rising coordinates `among`, from 0, is the nearest to x; nothing if it is not equal to x as a
/// decimal. A mesh computes its coordinates, with two roundings: 3 * 0.7 / 7 is not the double nearest to
/// 0.3. So coordinates are equal up to 4 roundings of the larger end of the structure.
[[nodiscard]] std::optional<int> find_coordinate(std::span<const double> among, double x);

/// Coordinates that a value in a problem file may name.
struct coordinate_row {
  std::span<const double> values;  ///< rising, at least two
  std::string_view what;           ///< "node" or "grid line"
  std::string_view remedy;         ///< what makes another coordinate one of these

  /// The number, from 0, of the coordinate that `named` is. Refuses any other number with the two nearest.
  [[nodiscard]] int index_of(const toml_value& named) const;
  /// The coordinate equal to `named`, or `named` itself if there is none; it must lie between the first and
  /// the last.
  [[nodiscard]] double place_of(const toml_value& named) const;

 private:
  void refuse_outside(const toml_value& named, double x) const;
};

/// The nodes of a beam.
[[nodiscard]] inline coordinate_row nodes_along(std::span<const double> x) {
  return {x, "node", "element_size in [beam] puts a node at every x that the file names"};
}

/// Is EI, or section, in the beam's table a list of pieces, each up to the x that it names?
[[nodiscard]] bool has_pieces(const toml_value& beam, std::string_view key);

/// Coordinates, and the runs of equal parts that they consist of.
struct mesh_line {
  std::vector<double> x;
  std::vector<even_run> runs;
};

/// A line from 0 to `length`, in so many equal parts.
[[nodiscard]] mesh_line even_line(double length, int elements);

/// The nodes of a beam with `element_size` in its table: at the coordinates `ends`, which rise, and at
/// every x that a table of the document `top` names between them, and elements of equal length between each
/// two of these, none longer than that.
[[nodiscard]] mesh_line sized_mesh(const toml_value& beam, const toml_value& top,
                                   const std::vector<double>& ends);

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

  /// Refuse `named`, which acts on dof `dof` of `node`, if that is one of the two slopes at a hinge.
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
  std::unordered_map<std::string_view, int> dofs_;  // of a matrix, by label; empty if labels are numbers
  std::vector<std::string_view> keys_;              // that for a single node first
  std::vector<std::string_view> dof_names_;         // of a node
};

}  // namespace contct
