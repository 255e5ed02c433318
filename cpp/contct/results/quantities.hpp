// Every number of a result as a row of one table: its name, its unit, where it is, and how it is read from a
// state.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/results/step_results.hpp"

namespace contct {

/// The list whose entries have a number. Beds and `structure`, which has one entry, have sums.
enum class on { nodes, pairs, supports, beds, hinges, element_ends, structure };

/// A list: how results name it and its entries, which count from 1.
struct list_row {
  std::string_view name;    ///< "pairs"
  std::string_view entry;   ///< "pair"; empty: entries have no number of their own
  std::string_view prefix;  ///< of the keys of its rows, which are without it in results
  /// The number of entries that the problem names, which every mesh has; null: the mesh decides.
  std::size_t (*count)(const problem&);
  int (*node)(const problem&, std::size_t entry);          ///< from 0; null: entries are at no node
  std::vector<std::string> entry_names::*names = nullptr;  ///< null: the file names no entry
};
[[nodiscard]] const list_row& list_of(on where);

/// The name that the file gives to an entry, from 0, or to the bed of a pair; empty: none.
[[nodiscard]] std::string_view name_of_entry(const problem& p, on where, std::size_t i);
/// The name of an entry before other words: "S4, "; empty without a name.
[[nodiscard]] std::string name_before(const problem& p, on where, std::size_t i);
/// The place of an entry at a node, with its name: "node 7", "S4, node 7".
[[nodiscard]] std::string entry_words(const problem& p, on where, std::size_t i);
/// The number of an entry, with its name: "bed 1", "bed 1, ballast".
[[nodiscard]] std::string numbered_words(const problem& p, on where, std::size_t i);

/// The lists whose entries every mesh has.
inline constexpr on lists_of_entries[] = {on::supports, on::pairs, on::beds, on::hinges, on::structure};

struct quantity_row {
  std::string_view key;    ///< in files: letters, digits and _
  std::string_view words;  ///< in tables
  unit in;                 ///< of a matrix, at dofs along an axis
  on where;
  std::optional<quantity> kind;  ///< the kind of number whose proved bound covers this one; empty: none does
  bool (*exists)(const problem&);
  /// The values in the order of the list; of an element, at its ends or corners one after the other. NaN: an
  /// entry without this number.
  std::vector<double> (*values)(const step_results&);
};

/// The key within the list: of "bed_force", "force" in `beds`; of "sum_of_loads", "loads" in `balance`.
[[nodiscard]] std::string_view key_in_list(const quantity_row& row);

/// The rows of the numbers that a problem has, all or those on one list.
[[nodiscard]] std::vector<const quantity_row*> quantities_of(const problem& p,
                                                             std::optional<on> list = std::nullopt);

/// The values of a quantity in a state.
struct quantity_column {
  const quantity_row* row;
  std::vector<double> values;
};
/// The columns of all quantities on a list.
[[nodiscard]] std::vector<quantity_column> columns_of(const step_results& r, on list);

/// The row of a value_range, of an extreme of an element or a node, or of a column of a curve.
[[nodiscard]] const quantity_row& row_named(const problem& p, std::string_view key);

/// A quantity along a beam, with its polynomial in each piece of an element.
struct line_row {
  std::string_view key;
  line_polynomial<double> element_line::*polynomial;
};
inline constexpr line_row along_beam[] = {
    {"w", &element_line::w}, {"moment", &element_line::moment}, {"shear", &element_line::shear}};

/// True if the problem has numbers of this kind.
[[nodiscard]] bool has_kind(const problem& p, quantity kind);

/// The least and largest value of a quantity in a part, from 0. `where` is the node's place; of a bed, the
/// place with that pressure.
struct watched_range {
  std::size_t part = 0;
  const quantity_row* row = nullptr;
  placed_value least, most;
};

/// A value at a node; `name`: of the entry that has it.
[[nodiscard]] placed_value at_node(const problem& p, double value, int node, std::string_view name = {});

/// All quantities of all parts, part after part. A range of places has the extremes of the structure and the
/// pressure of beds there; names have reactions, contact forces, gaps, and pressures of beds.
[[nodiscard]] std::vector<watched_range> watched_in(const step_results& r);

}  // namespace contct
