// The kinds of structure, behind one set of functions: the rooms that read, solve and write do not depend on
// the kind.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "contct/structure/assembled.hpp"
#include "contct/structure/beam.hpp"
#include "contct/structure/plate.hpp"

namespace contct::structure {

/// A structure without its supports. A new kind joins the variant and implements each function below.
struct model {
  std::variant<beam, plate, assembled> kind;
};

[[nodiscard]] int nodes(const model& m);
[[nodiscard]] int elements(const model& m);
[[nodiscard]] int dofs(const model& m);
[[nodiscard]] int dofs_per_node(const model& m);

/// Names of a node's dofs, in order, as problem files have them: the deflection "w" first. A matrix has one
/// dof a node, whose name is that of its loads, "value".
[[nodiscard]] std::span<const char* const> dof_names(const model& m);

/// "node"; "dof" where each dof is a node of its own.
[[nodiscard]] std::string_view node_name(const model& m);

/// A node in words: "node 3", or, where each dof is a node of its own, "dof 185.3". From 0.
[[nodiscard]] std::string place_words(const model& m, int node);

/// Assemble it on its supports. Throws std::invalid_argument when an entry of the stiffness matrix is
/// not a finite number, naming the element (from 1).
[[nodiscard]] linear_structure build(const model& m, std::span<const support> supports,
                                     std::vector<contact_pair> pairs);

/// Add the consistent load vector of `l` to `f` [dofs].
void add_consistent_loads(const model& m, const load& l, std::span<double> f);

/// The length or area of the structure that each node stands for [nodes].
[[nodiscard]] std::vector<double> tributary_shares(const model& m);

/// The force (or moment) on the structure by each support, in their order.
[[nodiscard]] std::vector<double> reactions(const model& m, const load& l, std::span<const support> supports,
                                            std::span<const double> u);

/// What an engineer reads off the elements: beams have "shear" and "moment" at 2 ends, plates "mx", "my"
/// and "mxy" at 4 corners, matrices nothing.
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

/// The sum of all upward forces, and the moments about the origin that go with it: one for each slope
/// among the dofs, positive as the slope is. A beam has one (sum of F x + theta's loads), a plate two
/// (F x + wx's loads, F y + wy's). A matrix has the sum of all its loads, whatever these are, and no moments.
struct resultant {
  double force = 0.0;
  std::vector<double> moments;
};

[[nodiscard]] resultant resultant_of(const model& m, const load& l);

}  // namespace contct::structure
