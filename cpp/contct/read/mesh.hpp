// Coordinates in a problem file: which node or grid line one names, and the nodes of a beam whose elements
// have a largest length.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/read/toml_reader.hpp"

namespace contct {

inline constexpr int most_elements = 2'000'000;

/// Which of the rising coordinates `among`, from 0, is the nearest to x; nothing where it is not equal to x
/// as a decimal. A mesh computes its coordinates, with two roundings: 3 * 0.7 / 7 is not the double nearest
/// to 0.3. So coordinates are equal up to 4 roundings of the larger end of the structure.
[[nodiscard]] std::optional<int> find_coordinate(std::span<const double> among, double x);

/// Coordinates that a value in a problem file may name.
struct coordinate_row {
  std::span<const double> values;  ///< rising, at least two
  std::string_view what;           ///< "node" or "grid line"
  std::string_view remedy;         ///< what makes another coordinate one of these

  /// The number, from 0, of the coordinate that `named` is. Refuses any other number with the two nearest.
  [[nodiscard]] int index_of(const toml_value& named) const;
  /// The coordinate that `named` is, or `named` itself if it is not a coordinate, from the first to the last
  /// of them.
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

/// Coordinates, and what they are made of.
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

}  // namespace contct
