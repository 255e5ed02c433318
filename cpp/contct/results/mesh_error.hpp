// The error that the mesh of a beam on beds makes, proved by a line with distributed pressure
// (proof/bed_line.hpp). Symbols are those of reference/mesh-error.md.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/proof/bed_line.hpp"
#include "contct/proof/solved_path.hpp"

namespace contct {

/// A bound on the error of all printed numbers of one kind, and the largest of them. `key`: of
/// quantity_names, pressure_name, bed_force_name or bed_contact_name.
struct mesh_number {
  std::string_view key;
  double error = 0.0, of = 0.0;
};

/// The extremes of w, moment or shear as printed and, up to rounding, without mesh error.
struct true_extremes {
  std::string_view key;
  double told_least, told_most, least, most;
  int least_step = 0, most_step = 0;  ///< steps of `least` and `most`
};

/// What is proved about the mesh's error of a state.
struct mesh_error {
  std::string not_proved = {};  ///< why nothing is proved, in words; empty if the bounds are proved
  std::vector<mesh_number> numbers = {};
  std::vector<true_extremes> extremes = {};   ///< empty unless w1 is within certificate::allowed
  std::shared_ptr<const bed_line> line = {};  ///< the proof: w1, and A in bed_along::certain

  /// Takes the error and the size of a printed number. `exact`: that of w1, which is off by at most `bound`.
  void take(const quantity_name& kind, double printed, double exact, double bound);
  /// Is every error, but that of gaps, at most `share` of the largest number of its kind?
  [[nodiscard]] bool is_within(double share) const;
};

/// The mesh of the line: that of a beam with beds, halved until the beds bend each element little.
[[nodiscard]] fine_mesh finely_divided(const problem& p);

/// Proves the mesh's error of the final state `s` of `p`, a beam with beds. `mesh`: see finely_divided.
[[nodiscard]] mesh_error mesh_error_of(const problem& p, const std::shared_ptr<const fine_mesh>& mesh,
                                       const solved_step& s);

/// The largest errors, sizes and extremes of all steps. Not proved if one is not.
[[nodiscard]] mesh_error largest_of(std::span<const mesh_error> all);

}  // namespace contct
