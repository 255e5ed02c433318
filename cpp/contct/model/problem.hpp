// A problem as a person wrote it down. One set of functions hides the kind of structure, so that reading,
// solving and writing do not depend on it.
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

#include "contct/model/structure.hpp"
#include "contct/text/strings.hpp"

namespace contct {

/// Coordinates at equal distances, each `end` of a run a number of the file.
struct even_run {
  double end;
  int elements;
};

/// A beam's cross-section as given in the file; 0: unknown.
struct beam_section {
  double E = 0.0, I = 0.0;  ///< EI is their product
  double W = 0.0;           ///< section modulus: M / W is the stress at the extreme fibres
  double A = 0.0;           ///< area
  double weight = 0.0;      ///< per volume
  bool operator==(const beam_section&) const = default;
};

/// A straight beam of Hermite elements: two dofs a node, w (up) and theta = dw/dx.
struct beam {
  std::vector<double> x;   ///< node coordinates, strictly increasing [nodes]
  std::vector<double> EI;  ///< bending stiffness of each element, positive [nodes - 1]
  /// The runs of equal parts that x consists of from x[0] on, for exact arithmetic; empty: every x is a
  /// number of the file.
  std::vector<even_run> runs = {};
  std::vector<beam_section> sections = {};  ///< [elements], EI their rounded products; empty: the file has EI
  /// Inner nodes, rising, where no moment is carried. A hinge releases the right end of the element on its
  /// left, whose rotation is condensed: the node's theta is that of the element on its right.
  std::vector<int> hinges = {};

  [[nodiscard]] bool has_hinge(int node) const {
    return std::binary_search(hinges.begin(), hinges.end(), node);
  }

  static constexpr int dofs_per_node = 2;
  static constexpr std::array<const char*, 2> dof_names = {"w", "theta"};
  [[nodiscard]] int nodes() const { return static_cast<int>(x.size()); }
  [[nodiscard]] int elements() const { return nodes() - 1; }
  [[nodiscard]] int dofs() const { return nodes() * dofs_per_node; }
  [[nodiscard]] double length_of(std::size_t element) const { return x[element + 1] - x[element]; }
  /// Have two elements the same section?
  [[nodiscard]] bool is_alike(int element, int other) const {
    return EI[element] == EI[other] && (sections.empty() || sections[element] == sections[other]);
  }
};

/// A rectangular Kirchhoff plate of Adini-Clough-Melosh elements: three dofs a node, the deflection w (up)
/// and the slopes wx = dw/dx, wy = dw/dy. It lies on a grid of lines. Everything counts from 0: grid point
/// (i, j), at x[i] and y[j], is node j * columns + i; the element with its lower left corner there is element
/// j * (columns - 1) + i.
struct plate {
  std::vector<double> x;              ///< grid lines, strictly increasing, at least two
  std::vector<double> y;              ///< the same
  double D = 0.0;                     ///< bending stiffness E t^3 / 12 (1 - nu^2), positive
  double nu = 0.0;                    ///< Poisson's ratio, above -1 and at most 0.5
  double E = 0.0;                     ///< Young's modulus that D is computed from; 0 where the file has D
  double thickness = 0.0;             ///< likewise
  std::vector<even_run> x_runs = {};  ///< as a beam's runs
  std::vector<even_run> y_runs = {};
  double weight = 0.0;  ///< per volume; 0 where the file has none

  static constexpr int dofs_per_node = 3;
  static constexpr std::array<const char*, 3> dof_names = {"w", "wx", "wy"};
  [[nodiscard]] int columns() const { return static_cast<int>(x.size()); }
  [[nodiscard]] int rows() const { return static_cast<int>(y.size()); }
  [[nodiscard]] int nodes() const { return columns() * rows(); }
  [[nodiscard]] int elements() const { return (columns() - 1) * (rows() - 1); }
  [[nodiscard]] int dofs() const { return nodes() * dofs_per_node; }
  [[nodiscard]] int node_at(int i, int j) const { return j * columns() + i; }
  /// An element's corners, counter-clockwise from the lower left: (i, j), (i+1, j), (i+1, j+1), (i, j+1).
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
  /// An element's size along x and along y.
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

/// A node, by the name that labels of dofs have for it.
struct placed_node {
  std::string name;
  std::array<double, 3> at;
};

/// A straight line between two nodes, from 0.
struct mesh_edge {
  int from, to;
  int elements;  ///< how many have it: few at the outer edges of a solid, many inside; 1 for a coupling
};

/// The position of a dof.
struct placed_dof {
  int node = -1;      ///< from 0; -1 if unknown
  int direction = 0;  ///< 1 to 3 along x, y and z, 4 to 6 about them; 0 if unknown

  [[nodiscard]] bool is_length() const { return direction >= 1 && direction <= 3; }
};

/// The known places of the dofs of an assembled structure: for pictures only.
struct placed_nodes {
  std::vector<placed_node> nodes;  ///< empty: nothing is known
  std::vector<mesh_edge> edges;    ///< from < to, each once
  std::vector<placed_dof> dofs;    ///< [dofs]; empty with `nodes`
  std::vector<std::string> notes;  ///< the parts of the files that are not drawn, a sentence each

  [[nodiscard]] bool known() const { return !nodes.empty(); }
};

/// A structure given by its stiffness matrix alone, which another program has assembled. Every dof is a node
/// of its own here, so that the listing's NDOFPN and INDOF are 1 and its ID the dof.
struct assembled {
  std::string name;                 ///< of the matrix, for messages: its file
  sparse_matrix stiffness;          ///< positive semidefinite
  std::vector<std::string> labels;  ///< [dofs] each once; empty: "1", "2", ...
  std::string labels_from;          ///< the file that has them
  std::vector<int> rows;            ///< [dofs] row of each dof in the band; empty: its own number
  bool as_band = true;              ///< otherwise K is stored by columns, for CHOLMOD
  std::optional<int> free_motions;  ///< the number of motions that stay free on its supports, if known
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

/// A structure of any kind, without its supports. A new kind joins the variant, and has the members above
/// that all kinds have, and elements in model/elements.hpp.
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

/// Names of a node's dofs, in order, as problem files have them: the deflection "w" first. A matrix has one
/// dof a node, whose name is that of its loads, "value".
[[nodiscard]] inline std::span<const char* const> dof_names(const model& m) {
  return std::visit([](const auto& kind) { return std::span<const char* const>(kind.dof_names); }, m.kind);
}

/// "node"; "dof" where each dof is a node of its own.
[[nodiscard]] inline std::string_view node_name(const model& m) {
  return std::holds_alternative<assembled>(m.kind) ? "dof" : "node";
}

/// A node in words: "node 3", or, where each dof is a node of its own, "dof 185.3". From 0.
[[nodiscard]] inline std::string place_words(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? "dof " + on_one_line(a->label_of(node)) : "node " + std::to_string(node + 1);
}

/// The row of each dof in its band; empty: its own number. A plate is numbered along its shorter side.
[[nodiscard]] std::vector<int> rows_in_band(const model& m);
/// Of that band.
[[nodiscard]] int subdiagonals(const model& m);

/// Assembles the model with its supports. The motions that supports leave free to a matrix are computed: see
/// find_free_motions. Throws std::invalid_argument when an entry of an element's stiffness is not a finite
/// number, naming the element (from 1); where a dof of a matrix has neither stiffness nor support; and as
/// find_free_motions does.
[[nodiscard]] linear_structure build(const model& m, std::span<const support> supports,
                                     std::vector<contact_pair> pairs);

/// Throws std::invalid_argument for a dof of a matrix that has neither stiffness nor support.
[[noreturn]] void refuse_without_stiffness(const assembled& a, int dof);

/// Add the consistent load vector of `l` to `f` [dofs]. Loads on a matrix are forces at dofs. Point loads at
/// one dof that are 0 as decimals are no load: 0.1, 0.2 and -0.3. Throws std::invalid_argument for a
/// distributed load on a plate that is not constant.
void add_consistent_loads(const model& m, const load& l, std::span<double> f);

/// The tributary length or area of each node [nodes]: of a plate, a quarter of each adjacent element. Throws
/// std::invalid_argument for a matrix, which has no lengths or areas.
[[nodiscard]] std::vector<double> tributary_shares(const model& m);

/// The force (or moment) on the structure by each support, in their order: minus spring times displacement
/// for an elastic one; for a fixed one, the forces of the adjacent elements, minus their loads and the point
/// loads at its dof. A dof fixed twice gives its reaction to the first.
[[nodiscard]] std::vector<double> reactions(const model& m, const load& l, std::span<const support> supports,
                                            std::span<const double> u);

/// What an engineer reads off the elements; a matrix has none. Neighbours each have a value of their own at a
/// node.
///
/// A beam's have "shear" and "moment" at 2 ends, left and right. Moment M = EI w'': positive when the beam
/// sags. Shear V = dM/dx = EI w''': the upward force that the part of the beam on the left of a cut exerts on
/// the part on the right.
///
/// A plate's have "mx", "my" and "mxy" per length at 4 corners, in the order of corners_of:
///     M_x = D (w_xx + nu w_yy),  M_y = D (w_yy + nu w_xx),  M_xy = D (1 - nu) w_xy.
/// M_x bends the plate along x and is positive when it sags; so is M_y along y. M_xy is positive where dw/dy
/// grows with x. The differences between neighbours go with the mesh.
struct element_results {
  std::vector<std::string_view> names;
  int places = 0;              ///< in an element
  std::vector<double> values;  ///< [elements][names][places]

  [[nodiscard]] std::size_t elements() const {
    return names.empty() ? 0 : values.size() / (names.size() * places);
  }
  /// Quantity `name` of an element, at all its places. Elements and names from 0.
  [[nodiscard]] std::span<const double> at(std::size_t element, std::size_t name) const {
    return std::span(values).subspan((element * names.size() + name) * places, places);
  }
};

/// The results in every element, under displacement `u` [dofs] and load `l`.
[[nodiscard]] element_results results_in_elements(const model& m, const load& l, std::span<const double> u);

/// The sum of all upward forces, and the moments about the origin that go with it: one for each slope among
/// the dofs, positive as the slope is. A beam has one (sum of F x + theta's loads), a plate two (F x + wx's
/// loads, F y + wy's). A matrix has the sum of all its loads, whatever these are, and no moments.
/// Summed exactly, from the decimals of the file, and rounded once.
struct resultant {
  double force = 0.0;
  std::vector<double> moments;
};

[[nodiscard]] resultant resultant_of(const model& m, const load& l);

/// Pairs that a [[bed]] made: one at each of its nodes, of stiffness modulus * share.
struct bed {
  double modulus;             ///< force per length (area) of deflection, positive
  std::vector<double> share;  ///< tributary length, or area, of each pair
  std::size_t first_pair;     ///< from 0; the others follow it
  /// If faces are a polynomial in x along a beam, its coefficients, constant first; otherwise empty.
  std::vector<double> face = {};
  std::optional<bool> closed = {};  ///< in contact at the start or not, if the file has it
};

/// Labels for people; nothing is converted. Both are empty, or neither.
struct unit_labels {
  std::string length, force;
};

/// The keys in a file that give a pair its face and its stiffness: "contact[2].face[3]".
struct pair_keys {
  std::string face, stiffness;
};

/// The contents of a problem file. Nodes, elements and pairs count from 0 here, from 1 in the file.
struct problem {
  std::string title;
  model geometry;
  std::vector<support> supports;
  std::vector<contact_pair> pairs;  ///< all [[contact]] in file order, then the beds'
  std::vector<load> steps;          ///< total load at the end of each step
  std::vector<bed> beds;            ///< whose pairs are among `pairs`
  unit_labels units;
  std::vector<std::string> warnings;
  std::vector<std::string> files;  ///< paths of the files that the problem file names
  /// The keys of the pairs of every [[contact]] [pairs]; pairs of beds have none.
  std::vector<pair_keys> keys;
};

/// The unit of a quantity, with a blank before it: of "w", "moment", "shear", "mx", "force", "pressure",
/// "contact" (of a bed), ..; empty if the problem names no units. With a matrix: the unit of "w" and "force"
/// at `dof`, from 0, if the kind of the dof is known, because it has a pair or a known position.
[[nodiscard]] std::string unit_words(const problem& p, std::string_view quantity, int dof = -1);
/// Are its steps combinations, each from the unloaded structure?
[[nodiscard]] inline bool starts_from_zero(const problem& p) {
  return !p.steps.empty() && p.steps.front().from_zero;
}
/// The pairs under a load, their faces where it has moved them.
[[nodiscard]] std::vector<contact_pair> pairs_under(const problem& p, const load& l);

}  // namespace contct
