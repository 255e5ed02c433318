// Finds the nodes that a table of a problem file names by number, coordinate or label. Makes the nodes of a
// beam from its key element_size.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contct/number/rational.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/structure/line.hpp"

namespace contct {

inline constexpr int most_elements = 2'000'000;

/// The nodes or grid lines along a line, which a number in a problem file may name. The number is the node's
/// if it equals the node's exact place as a decimal. With equal parts, whose places may have no end as a
/// decimal, also if it has 12 digits or more and the place rounds to these digits; this draws a warning.
class coordinate_row {
 public:
  /// `values`: ascending, at least two. `what`: "node" or "grid line". `remedy`: how to add a coordinate.
  coordinate_row(std::span<const double> values, std::span<const even_run> runs, std::string_view what,
                 std::string_view remedy)
      : points_(values, runs), is_even_(!runs.empty()), what_(what), remedy_(remedy) {}

  [[nodiscard]] const line<rational>& points() const { return points_; }
  /// The index, from 0, of the node at `named`, or at the exact place `at`, whose rounded value is `near`;
  /// empty if there is none. Refuses numbers outside the line.
  [[nodiscard]] std::optional<int> find(const toml_value& named) const;
  [[nodiscard]] std::optional<int> find(const rational& at, double near) const;
  /// As `find`, but refuses a number that is not a node's; the message names the two nearest nodes.
  [[nodiscard]] int index_of(const toml_value& named) const;
  /// The place of a node, or the node at `named`, or else the decimal `named`.
  [[nodiscard]] line_place place(std::size_t node) const;
  [[nodiscard]] line_place place_of(const toml_value& named) const;

 private:
  [[nodiscard]] std::string words(std::size_t node) const;

  line<rational> points_;
  bool is_even_;
  std::string_view what_, remedy_;
};

[[nodiscard]] inline coordinate_row nodes_along(const beam& b) {
  return {b.x, b.runs, "node", "element_size in [beam] puts a node at every x that the file names"};
}

/// True if `key` (EI or section of [beam], modulus of a bed) is a list of pieces, each with its end `to`.
[[nodiscard]] bool has_pieces(const toml_value& t, std::string_view key);

/// Coordinates, and the runs of equal parts that the line consists of.
using mesh_line = std::pair<std::vector<double>, std::vector<even_run>>;

/// A line from 0 to `length` with `elements` equal elements.
[[nodiscard]] mesh_line even_line(double length, int elements);

/// Makes the nodes of a beam whose table has element_size: at the ascending coordinates `ends`; between the
/// ends, at the values of the keys x of the document `top` and at the ends of beds and pieces; and between
/// two neighbours of these nodes, more nodes at equal distances of at most element_size.
[[nodiscard]] mesh_line sized_mesh(const toml_value& beam, const toml_value& top,
                                   const std::vector<double>& ends);

/// A node, or a place between two nodes of a beam.
struct named_place {
  std::optional<int> node;  ///< from 0
  double x = 0.0;           ///< if there is no node
};

/// Kinds of structures: sums of the numbers of single kinds.
enum structure_kinds : unsigned { beams = 1, plates = 2, matrices = 4, all_structures = 7 };

/// Reads the keys that name nodes: node, nodes, and x (beams) or at (plates); dof and dofs on a matrix.
class node_reader {
 public:
  /// `m` must outlive this object.
  explicit node_reader(const model& m);

  [[nodiscard]] const model& structure() const { return structure_; }
  [[nodiscard]] bool on(unsigned kinds) const { return (kinds >> structure_.kind.index() & 1U) != 0; }
  [[nodiscard]] bool on_matrix() const { return matrix_ != nullptr; }
  /// The nodes along x of a beam; the grid lines along x and y of a plate; empty for a matrix.
  [[nodiscard]] const std::vector<coordinate_row>& axes() const { return axes_; }
  [[nodiscard]] const std::vector<std::string_view>& dof_names() const { return dof_names_; }

  /// Returns the keys that name nodes, followed by `others`, for toml_value::allow_only.
  [[nodiscard]] std::vector<std::string_view> keys_with(std::vector<std::string_view> others) const;

  [[nodiscard]] bool named_in(const toml_value& t) const { return t.has(key_in(t)); }

  /// The nodes that a table names, from 0, in its order; at least one. Refuses a node that is named twice.
  [[nodiscard]] std::vector<int> read(const toml_value& t) const;
  /// As `read`; with `between_nodes`, the key x of a beam may also name places between nodes.
  [[nodiscard]] std::vector<named_place> places(const toml_value& t, bool between_nodes) const;

  /// Reads the part on which a load or bed acts: places `from` and `to` along a beam, or two corners of a
  /// rectangle of a plate. A missing `from` is the start of the beam or the lower left corner of the plate, a
  /// missing `to` the opposite end or corner.
  struct area {
    std::array<line_place, 2> from, to;  ///< along each axis
  };
  [[nodiscard]] area read_area(const toml_value& t) const;

  /// Reads labels of dofs of a matrix, from 0: [count] one label for all pairs, or one for each pair.
  [[nodiscard]] std::vector<int> labelled(const toml_value& named, std::size_t count) const;

  /// Calls `take` for every dof, from 0, whose name is a key of `t`, and every place of `at`; `named` is the
  /// value of this key. Refuses a table without such a key, which `found` describes, and theta at a hinge.
  using taker = std::function<void(const toml_value& named, const named_place& at, int dof, double value)>;
  void read_values(const toml_value& t, std::string_view found, const real_range& range,
                   const std::vector<named_place>& at, const taker& take) const;

  /// Refuses the value `named` if `dof` of `node` is theta at a hinge, where the beam has two slopes.
  void refuse_hinge(const toml_value& named, int node, int dof) const;

 private:
  [[nodiscard]] std::string_view key_in(const toml_value& t) const;
  [[nodiscard]] int node_at(const toml_value& named) const;
  [[nodiscard]] int dof_at(const toml_value& named) const;
  [[nodiscard]] std::string labels_allowed() const;

  const model& structure_;
  std::vector<coordinate_row> axes_;
  const assembled* matrix_;                         // null: the structure is a beam or a plate
  std::unordered_map<std::string_view, int> dofs_;  // by label; empty if labels are numbers
  std::vector<std::string_view> keys_;              // the key for a single node first
  std::vector<std::string_view> dof_names_;
};

}  // namespace contct
