// The contents of a problem file. The functions of `model` work for every kind of structure, so that reading,
// solving and writing do not depend on the kind.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "contct/structure/structure.hpp"
#include "contct/text/strings.hpp"

namespace contct {

/// Elements of equal length up to the coordinate `end`, which is a number of the file.
struct even_run {
  double end;
  int elements;
};

/// A beam's cross-section as in the file; 0: unknown.
struct beam_section {
  double E = 0.0, I = 0.0;   ///< EI is the product of E and I
  double W = 0.0;            ///< section modulus: M / W is the stress at the extreme fibres
  double A = 0.0;            ///< area
  double G = 0.0, As = 0.0;  ///< GA is the product of the shear modulus and the shear area
  double weight = 0.0;       ///< per volume
  bool operator==(const beam_section&) const = default;
};

/// The keys of a section.
struct section_key {
  std::string_view name;
  double beam_section::*value = nullptr;
  bool required = false;
};
inline constexpr section_key section_keys[] = {
    {"E", &beam_section::E, true},    {"I", &beam_section::I, true}, {"W", &beam_section::W},
    {"A", &beam_section::A},          {"G", &beam_section::G},       {"As", &beam_section::As},
    {"weight", &beam_section::weight}};

/// A straight beam of Hermite elements or, with shear flexibility, Timoshenko elements: two dofs a node, w
/// (up) and theta, the rotation of the section: dw/dx = theta - V / GA.
struct beam {
  std::vector<double> x;   ///< node coordinates, strictly increasing [nodes]
  std::vector<double> EI;  ///< bending stiffness of each element, positive [nodes - 1]
  /// The runs of equal elements from x[0] on, for exact arithmetic; empty if the file gives every x.
  std::vector<even_run> runs = {};
  std::vector<beam_section> sections = {};  ///< [elements] EI is E times I, rounded; empty: the file gives EI
  /// The inner nodes with hinges, ascending. A hinge releases the right end of the element on its left, and
  /// the rotation of this end is condensed. The node's theta belongs to the element on its right.
  std::vector<int> hinges = {};
  /// [hinges] moment by rotation, theta on the right minus that on the left; 0, or none: free.
  std::vector<double> hinge_stiffness = {};
  std::vector<double> GA = {};  ///< shear stiffness of each element, positive; empty: no shear flexibility

  [[nodiscard]] bool has_hinge(int node) const {
    return std::binary_search(hinges.begin(), hinges.end(), node);
  }
  /// The stiffness of the hinge at `node`; 0 if it is free, or if the node has none.
  [[nodiscard]] double stiffness_of_hinge(int node) const {
    const auto at = static_cast<std::size_t>(std::ranges::lower_bound(hinges, node) - hinges.begin());
    return has_hinge(node) && at < hinge_stiffness.size() ? hinge_stiffness[at] : 0.0;
  }
  /// The nodes between which the beam stays straight when it moves without bending: ends and free hinges.
  [[nodiscard]] std::vector<int> corners() const {
    std::vector<int> all = {0};
    for (const int node : hinges)
      if (stiffness_of_hinge(node) == 0.0) all.push_back(node);
    all.push_back(nodes() - 1);
    return all;
  }

  static constexpr int dofs_per_node = 2;
  static constexpr std::array<const char*, 2> dof_names = {"w", "theta"};
  [[nodiscard]] int nodes() const { return static_cast<int>(x.size()); }
  [[nodiscard]] int elements() const { return nodes() - 1; }
  [[nodiscard]] int dofs() const { return nodes() * dofs_per_node; }
  [[nodiscard]] double length_of(std::size_t element) const { return x[element + 1] - x[element]; }
  [[nodiscard]] bool is_alike(int element, int other) const {
    return EI[element] == EI[other] && (sections.empty() || sections[element] == sections[other]) &&
           (GA.empty() || GA[element] == GA[other]);
  }
};

/// The keys of a beam's table with a number for each element, which a section may replace.
struct element_key {
  const char* name = "";
  std::vector<double> beam::*values = nullptr;
  bool required = false;
};
inline constexpr element_key element_keys[] = {{"EI", &beam::EI, true}, {"GA", &beam::GA}};

/// A rectangular Kirchhoff plate of Adini-Clough-Melosh elements: three dofs a node, the deflection w (up)
/// and the slopes wx = dw/dx, wy = dw/dy. The nodes are the points of a grid. All numbers count from 0: grid
/// point (i, j), at x[i] and y[j], is node j * columns + i. The element with this lower left corner is
/// element j * (columns - 1) + i.
struct plate {
  std::vector<double> x;              ///< grid lines, strictly increasing, at least two
  std::vector<double> y;              ///< grid lines, as x
  double D = 0.0;                     ///< bending stiffness E t^3 / (12 (1 - nu^2)), positive
  double nu = 0.0;                    ///< Poisson's ratio, above -1 and at most 0.5
  double E = 0.0;                     ///< Young's modulus; 0 if the file gives D
  double thickness = 0.0;             ///< 0 if the file gives D
  std::vector<even_run> x_runs = {};  ///< as beam::runs
  std::vector<even_run> y_runs = {};
  double weight = 0.0;  ///< weight per volume; 0 if the file gives none

  static constexpr int dofs_per_node = 3;
  static constexpr std::array<const char*, 3> dof_names = {"w", "wx", "wy"};
  [[nodiscard]] int columns() const { return static_cast<int>(x.size()); }
  [[nodiscard]] int rows() const { return static_cast<int>(y.size()); }
  [[nodiscard]] int nodes() const { return columns() * rows(); }
  [[nodiscard]] int elements() const { return (columns() - 1) * (rows() - 1); }
  [[nodiscard]] int dofs() const { return nodes() * dofs_per_node; }
  [[nodiscard]] int node_at(int i, int j) const { return j * columns() + i; }
  /// The corners of an element, counter-clockwise from the lower left: (i, j), (i+1, j), (i+1, j+1),
  /// (i, j+1).
  [[nodiscard]] std::array<int, 4> corners_of(int element) const {
    const int i = element % (columns() - 1);
    const int j = element / (columns() - 1);
    return {node_at(i, j), node_at(i + 1, j), node_at(i + 1, j + 1), node_at(i, j + 1)};
  }
  /// The twelve dofs of an element, corner by corner.
  [[nodiscard]] std::array<int, 12> dofs_of(int element) const {
    std::array<int, 12> dofs{};
    std::size_t next = 0;
    for (const int node : corners_of(element))
      for (int d = 0; d < dofs_per_node; ++d) dofs[next++] = dofs_per_node * node + d;
    return dofs;
  }
  [[nodiscard]] double width_of(int element) const {
    const int i = element % (columns() - 1);
    return x[i + 1] - x[i];
  }
  [[nodiscard]] double height_of(int element) const {
    const int j = element / (columns() - 1);
    return y[j + 1] - y[j];
  }
};

/// D of a plate of Young's modulus E, Poisson's ratio nu and thickness t.
[[nodiscard]] inline double bending_stiffness(double E, double nu, double t) {
  return E * t * t * t / 12 / (1 - nu * nu);
}

/// A node: its name in the labels of dofs, and its coordinates.
struct placed_node {
  std::string name;
  std::array<double, 3> at;
};

/// A straight line between the nodes `from` and `to`, which count from 0.
struct mesh_edge {
  int from, to;
  int elements;  ///< the number of elements that have this edge; 1 for a coupling
};

/// The node and the direction of a dof.
struct placed_dof {
  int node = -1;      ///< from 0; -1 if unknown
  int direction = 0;  ///< 1 to 3 along x, y and z, 4 to 6 about them; 0 if unknown

  [[nodiscard]] bool is_length() const { return direction >= 1 && direction <= 3; }
};

/// The positions of the dofs of an assembled structure, for pictures only.
struct placed_nodes {
  std::vector<placed_node> nodes;  ///< empty: no position is known
  std::vector<mesh_edge> edges;    ///< from < to, each edge once
  std::vector<placed_dof> dofs;    ///< [dofs]; empty if `nodes` is empty
  std::vector<std::string> notes;  ///< the parts of the files that are not drawn, a sentence each
  std::string from = {};           ///< the file with the places

  [[nodiscard]] bool known() const { return !nodes.empty(); }
};

/// A structure given by a stiffness matrix that another program assembled. Each dof is a node, so that NDOFPN
/// and INDOF of the listing are 1 and ID is the number of the dof.
struct assembled {
  std::string name;                 ///< the matrix's file, for messages
  std::string sha256;               ///< of this file
  sparse_matrix stiffness;          ///< positive semidefinite
  std::vector<std::string> labels;  ///< [dofs] unique; empty: "1", "2", ...
  std::string labels_from;          ///< the file with the labels
  std::vector<int> rows;            ///< [dofs] the row of each dof in the band; empty: row and dof are equal
  bool as_band = true;              ///< if false, K is stored by columns, for CHOLMOD
  std::optional<int> free_motions;  ///< the number of rigid-body motions on its supports, if known
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

/// A structure of any kind, without its supports. A new kind needs an alternative in the variant, the members
/// that beam, plate and assembled have in common, and elements in structure/elements.hpp.
struct model {
  model() = default;
  model(beam b) : kind(std::move(b)) {}       // NOLINT(google-explicit-constructor): a beam is a structure
  model(plate p) : kind(std::move(p)) {}      // NOLINT(google-explicit-constructor)
  model(assembled a) : kind(std::move(a)) {}  // NOLINT(google-explicit-constructor)

  std::variant<beam, plate, assembled> kind;
};

[[nodiscard]] inline int nodes(const model& m) {
  return std::visit([](const auto& kind) { return kind.nodes(); }, m.kind);
}
[[nodiscard]] inline int elements(const model& m) {
  return std::visit([](const auto& kind) { return kind.elements(); }, m.kind);
}
[[nodiscard]] inline int dofs(const model& m) {
  return std::visit([](const auto& kind) { return kind.dofs(); }, m.kind);
}
[[nodiscard]] inline int dofs_per_node(const model& m) {
  return std::visit([](const auto& kind) { return kind.dofs_per_node; }, m.kind);
}

/// The names of a node's dofs in problem files, in order: the deflection "w" first. For a matrix: "value",
/// the key of its loads.
[[nodiscard]] inline std::span<const char* const> dof_names(const model& m) {
  return std::visit([](const auto& kind) { return std::span<const char* const>(kind.dof_names); }, m.kind);
}

/// "node", or "dof" for a matrix.
[[nodiscard]] inline std::string_view node_name(const model& m) {
  return std::holds_alternative<assembled>(m.kind) ? "dof" : "node";
}

/// A node (from 0) in words: "node 3", or "dof 185.3" for a matrix.
[[nodiscard]] inline std::string place_words(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? "dof " + on_one_line(a->label_of(node)) : "node " + std::to_string(node + 1);
}

/// [dofs] the row of each dof in the band; empty: row and dof are equal. Plates are numbered along the
/// shorter side, which gives the smallest bandwidth.
[[nodiscard]] std::vector<int> rows_in_band(const model& m);
/// The number of subdiagonals of the band in the order of rows_in_band.
[[nodiscard]] int subdiagonals(const model& m);

/// Assembles the model with its supports. For a matrix, finds the rigid-body motions that the supports leave
/// free: see find_free_motions. Throws std::invalid_argument if an entry of an element's stiffness is not a
/// finite number, naming the element (from 1); if a dof of a matrix has neither stiffness nor support; and as
/// find_free_motions does.
[[nodiscard]] linear_structure build(const model& m, std::span<const support> supports,
                                     const std::vector<contact_pair>& pairs);

/// Throws std::invalid_argument, which says that `dof` of a matrix has neither stiffness nor support.
[[noreturn]] void refuse_without_stiffness(const assembled& a, int dof);

/// [nodes] the tributary length or area of each node: for a plate, a quarter of each adjacent element. Throws
/// std::invalid_argument for a matrix, which has no lengths or areas.
[[nodiscard]] std::vector<double> tributary_shares(const model& m);
/// The same from the decimals of the coordinates, rounded once. tributary_shares subtracts rounded
/// coordinates, as the pairs' stiffness always did; far from x = 0 few of its digits are right.
[[nodiscard]] std::vector<double> exact_shares(const model& m);

/// Shear and moments in the elements; a matrix has no elements. Adjacent elements may have different values
/// at their common node.
///
/// A beam has "shear" and "moment" at the left and right end of each element. The moment M = EI w'' is
/// positive when the beam sags. The shear V = dM/dx = EI w''' is the upward force that the part of the beam
/// on the left of a cut exerts on the part on the right.
///
/// A plate has "mx", "my" and "mxy", per length, at the 4 corners of each element, in the order of
/// corners_of:
///     M_x = D (w_xx + nu w_yy),  M_y = D (w_yy + nu w_xx),  M_xy = D (1 - nu) w_xy.
/// M_x bends the plate along x, M_y along y; both are positive when the plate sags. M_xy is positive where
/// dw/dy grows with x. A finer mesh makes the differences between adjacent elements smaller.
struct element_results {
  std::vector<std::string_view> names;
  int places = 0;              ///< the number of places in an element
  std::vector<double> values;  ///< [elements][names][places]

  [[nodiscard]] std::size_t elements() const {
    return names.empty() ? 0 : values.size() / (names.size() * places);
  }
  /// Quantity `name` of an element at all its places. Elements and names count from 0.
  [[nodiscard]] std::span<const double> at(std::size_t element, std::size_t name) const {
    return std::span(values).subspan((element * names.size() + name) * places, places);
  }
};

/// The sum of all upward forces, and the moments about the origin: one for each slope among the dofs,
/// positive as this slope. Beam: the sum of F x and the loads on theta. Plate: the sum of F x and the loads
/// on wx; the sum of F y and the loads on wy. Matrix: the sum of all loads, of any kind, and no moments. All
/// sums are exact sums of the decimals in the file, rounded once.
struct resultant {
  double force = 0.0;
  std::vector<double> moments;
};

[[nodiscard]] resultant resultant_of(const model& m, const load& l);

/// A part of a bed with one modulus, along x and on a plate along y.
struct bed_part {
  std::array<line_place, 2> from, to;
  double modulus = 0.0;  ///< force per length (area) of deflection, positive
};

/// The pairs of a [[bed]]: one at each node of the bed, with stiffness modulus * share. The share is what of
/// the node's half elements, or quarters, lies inside the bed.
struct bed {
  double modulus;             ///< the largest of its parts
  std::vector<double> share;  ///< length, or area, of each pair
  std::size_t first_pair;     ///< the first pair of the bed, from 0; its other pairs follow
  /// The coefficients, constant first, if the faces are a polynomial in x along a beam; otherwise empty.
  std::vector<double> face = {};
  std::optional<bool> closed = {};   ///< in contact at the start; empty: the file does not say
  std::vector<int> nodes = {};       ///< ascending, fixed ones too: the bed has their whole half elements
  std::vector<bed_part> parts = {};  ///< instead of nodes; they do not overlap
  /// At nodes that a support fixes in w: pairs without calls, whose force is part of the reaction.
  std::vector<contact_pair> held = {};
  std::vector<double> held_share = {};
};

/// The names of the units, which are only printed. Length and force are either both given or both empty.
struct unit_labels {
  std::string length, force;
};

/// The keys of the problem file that give a pair its face and its stiffness: "contact[2].face[3]".
struct pair_keys {
  std::string face, stiffness;
};

/// The names that the file gives to supports, pairs of [[contact]] and beds; empty if it gives none. A finer
/// mesh may have more supports, without names.
struct entry_names {
  std::vector<std::string> supports, pairs, beds;
};

/// A part whose extremes are told besides those of the whole structure: places from `from` to `to`, along x
/// and on a plate along y, or the supports, pairs and beds with these names.
struct watched_part {
  std::string name;
  std::array<double, 2> from{}, to{};
  std::vector<std::string> names = {};  ///< empty: from, to

  [[nodiscard]] bool has(double x, double y) const {
    return from[0] <= x && x <= to[0] && from[1] <= y && y <= to[1];
  }
};

/// The contents of a problem file. Nodes, elements and pairs count from 0 here, from 1 in the file.
struct problem {
  std::string title;
  std::string project, author, revision;  ///< for the head of a report
  model geometry;
  std::vector<support> supports;
  std::vector<contact_pair> pairs;  ///< the pairs of every [[contact]] in file order, then those of beds
  std::vector<load> steps;          ///< total load at the end of each step
  std::vector<load> cases;          ///< of combinations and trains, without factors
  std::vector<bed> beds;            ///< the pairs of the beds are in `pairs`
  unit_labels units;
  std::vector<std::string> warnings;
  std::vector<std::string> files;  ///< paths of the files that the problem file names
  /// [pairs of every [[contact]]] the keys of each pair, in the order of `pairs`; pairs of beds have no keys.
  std::vector<pair_keys> keys;
  entry_names names;
  std::vector<watched_part> watches;
};

/// The kinds of units. Moments in plates are per length; pressures are forces per length of a beam or per
/// area of a plate, and `extent` is that length or area.
enum class unit { none, length, force, moment, plate_moment, stress, pressure, extent };

/// The name of a unit; empty if the problem names no units.
[[nodiscard]] std::string unit_name(const problem& p, unit u);
/// The name of a unit with a blank before it. For a matrix: the unit of a displacement or a force at `dof`
/// (from 0), if a pair or a known position shows the kind of the dof; otherwise empty.
[[nodiscard]] std::string unit_words(const problem& p, unit u, int dof = -1);

/// True if the steps are combinations, each applied to the unloaded structure.
[[nodiscard]] inline bool starts_from_zero(const problem& p) {
  return !p.steps.empty() && p.steps.front().from_zero;
}

}  // namespace contct
