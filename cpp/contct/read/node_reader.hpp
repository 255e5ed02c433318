// Finds the nodes that a table of a problem file names by number, coordinate or label. Makes the nodes of a
// beam from its key element_size.
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

/// The index, from 0, of x in the ascending coordinates `among`; empty if x is not one of the coordinates. A
/// coordinate of a mesh has two roundings: 3 * 0.7 / 7 is not the double nearest to 0.3. So x may differ from
/// a coordinate by 4 machine epsilons times the larger magnitude of the two ends.
[[nodiscard]] std::optional<int> find_coordinate(std::span<const double> among, double x);

/// Coordinates that a value in a problem file may name.
struct coordinate_row {
  std::span<const double> values;  ///< ascending, at least two
  std::string_view what;           ///< "node" or "grid line"
  std::string_view remedy;         ///< advice in messages: how to add a coordinate

  /// The index, from 0, of the coordinate equal to `named`. Refuses any other number; the message names the
  /// two nearest coordinates.
  [[nodiscard]] int index_of(const toml_value& named) const;
  /// The coordinate equal to `named`; if there is none, `named` itself, which must be between the first and
  /// the last coordinate.
  [[nodiscard]] double place_of(const toml_value& named) const;

 private:
  void refuse_outside(const toml_value& named, double x) const;
};

[[nodiscard]] inline coordinate_row nodes_along(std::span<const double> x) {
  return {x, "node", "element_size in [beam] puts a node at every x that the file names"};
}

/// True if `key` (EI or section) of the table [beam] is a list of pieces, each with its end `to`.
[[nodiscard]] bool has_pieces(const toml_value& beam, std::string_view key);

/// Coordinates, and the runs of equal parts that the line consists of.
struct mesh_line {
  std::vector<double> x;
  std::vector<even_run> runs;
};

/// A line from 0 to `length` with `elements` equal elements.
[[nodiscard]] mesh_line even_line(double length, int elements);

/// Makes the nodes of a beam whose table has element_size: at the ascending coordinates `ends`; between the
/// ends, at the values of the keys x of the document `top` and at the ends of pieces of EI or section; and
/// between two neighbours of these nodes, more nodes at equal distances of at most element_size.
[[nodiscard]] mesh_line sized_mesh(const toml_value& beam, const toml_value& top,
                                   const std::vector<double>& ends);

/// Reads the keys that name nodes: node, nodes, and x (beams) or at (plates); dof and dofs on a matrix.
class node_reader {
 public:
  /// `m` must outlive this object.
  explicit node_reader(const model& m);

  /// Returns the keys that name nodes, followed by `others`, for toml_value::allow_only.
  [[nodiscard]] std::vector<std::string_view> keys_with(std::vector<std::string_view> others) const;

  [[nodiscard]] bool named_in(const toml_value& t) const { return t.has(key_in(t)); }

  /// The nodes that a table names, from 0, in its order; at least one. Refuses a node that is named twice.
  [[nodiscard]] std::vector<int> read(const toml_value& t) const;

  [[nodiscard]] const model& structure() const { return structure_; }
  [[nodiscard]] bool on_matrix() const { return matrix_ != nullptr; }

  /// The dofs of a matrix, from 0, that `named` lists by label [count]: one for all pairs, or one for each.
  [[nodiscard]] std::vector<int> labelled(const toml_value& named, std::size_t count) const;

  /// The dofs of a node, from 0, whose names are keys of a table. Refuses a table without such a key.
  [[nodiscard]] std::vector<int> dofs_in(const toml_value& t, std::string_view found) const;

  /// Refuses the value `named` if `dof` of `node` is theta at a hinge, where the beam has two slopes.
  void refuse_hinge(const toml_value& named, int node, int dof) const;

  [[nodiscard]] const std::vector<std::string_view>& dof_names() const { return dof_names_; }

 private:
  [[nodiscard]] std::string_view key_in(const toml_value& t) const;
  [[nodiscard]] int node_at(const toml_value& named) const;
  [[nodiscard]] int dof_at(const toml_value& named) const;
  [[nodiscard]] std::string labels_allowed() const;

  const model& structure_;
  const assembled* matrix_;                         // null: the structure is a beam or a plate
  std::unordered_map<std::string_view, int> dofs_;  // by label; empty if labels are numbers
  std::vector<std::string_view> keys_;              // the key for a single node first
  std::vector<std::string_view> dof_names_;
};

}  // namespace contct
