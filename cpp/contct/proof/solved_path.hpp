// The path of a problem: the end of each step, with its certificate, and how the path ended.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

enum class quantity { w, slope, force, reaction, moment, shear, gap };
/// A kind of number, in the order of `quantity`: its key in results, and the name of one number of the kind.
struct quantity_name {
  const char *key, *words;
};
inline constexpr std::array<quantity_name, 7> quantity_names = {{{"w", "deflection"},
                                                                 {"slope", "slope"},
                                                                 {"force", "contact force"},
                                                                 {"reaction", "reaction"},
                                                                 {"moment", "moment"},
                                                                 {"shear", "shear force"},
                                                                 {"gap", "gap"}}};
inline constexpr quantity_name pressure_name = {"pressure", "pressure"};
inline constexpr quantity_name bed_force_name = {"bed_force", "force of a bed"};
inline constexpr quantity_name bed_contact_name = {"bed_contact", "length in contact"};
[[nodiscard]] constexpr const quantity_name& name_of(quantity q) {
  return quantity_names[static_cast<std::size_t>(q)];
}

/// One number for each kind; empty if the structure has no numbers of that kind.
struct by_quantity {
  std::array<std::optional<double>, quantity_names.size()> all;
  [[nodiscard]] std::optional<double>& operator[](quantity q) { return all[static_cast<std::size_t>(q)]; }
  [[nodiscard]] const std::optional<double>& operator[](quantity q) const {
    return all[static_cast<std::size_t>(q)];
  }
  /// Keeps the larger of `value` and the number stored for `q`; NaN counts as infinite.
  void take(quantity q, double value);
};

/// The proved facts about the contacts of a state.
struct contact_set {
  bool unique = true;  ///< false: other displacements balance the load too, so displacements have no bound
  /// False: K is not proved semidefinite, so there may be another equilibrium, farther away than rho.
  bool convex = true;
  std::string not_proved;  ///< why nothing is proved about the contacts, in words; empty if A is proved
  /// A bound on the distance to the equilibrium in the norm of K_A.
  double rho = std::numeric_limits<double>::infinity();
  std::vector<int> closed;  ///< A: the pairs certainly in contact, from 0
};

struct step_proof;  // contct/proof/error_bounds.hpp

struct error_bounds : contact_set {
  /// Bounds on the largest error of each kind of number; empty for a kind without numbers or without a bound.
  by_quantity error;
  std::optional<double> pressure;  ///< the same for bearing pressures; empty without beds
  by_quantity size;      ///< the largest number of each kind; nodal loads count as forces and moments
  by_quantity settling;  ///< if no load acts: the largest K_ii times settlement of dof i
  /// No node is loaded or settles, and at zero displacement no pair is beyond its face: u = 0 is an
  /// equilibrium.
  bool at_rest = false;
  bool unloaded = false;  ///< at rest, and no load acts inside elements either
  /// The largest residual of a dof divided by sqrt(K_ii), relative to the largest displacement times
  /// sqrt(K_ii).
  double equilibrium = 0.0;
  double beyond_face = 0.0;  ///< the largest depth of a separated pair beyond its face
  double off_face = 0.0;     ///< the largest distance of a pair in contact from its face
  double largest_deflection = 0.0;
  /// The first pair, from 0, whose status is certainly wrong.
  std::optional<std::size_t> wrong_status;
  std::shared_ptr<const step_proof> proof;  ///< the data that prove the bounds; null unless proofs are kept
};

/// The certificate of a step's final state. Each share is an error divided by the size of the number's kind,
/// which allowed_errors computes from the state itself or, if no load acts, from the path.
struct certificate : error_bounds {
  bool certified = false;           ///< every error is proved to be at most certified_share
  bool proved = false;              ///< the bounds are proved; otherwise no error is known
  by_quantity allowed = {};         ///< the errors that a certified state may have, absolute
  double worst_share = 0.0;         ///< the largest share of an error
  double displacement_error = 0.0;  ///< the largest share of an error of a deflection
  double penetration = 0.0;         ///< `beyond_face` as a share of the size of gaps
  double tension = 0.0;             ///< `off_face` as a share of the size of gaps
  std::string problem = {};         ///< what is wrong, in words; empty if certified
  std::string rule = {};            ///< what is allowed instead; empty: errors up to certified_share
  int pulling = -1;                 ///< not certified: the pair in contact that pulls most, from 0; -1: none
  double pull = 0.0;                ///< the tensile force of that pair
};

/// The number of decimal digits that are proved for every number of a state, relative to the size of the
/// number's kind: 0 (nothing is proved) to 15.
[[nodiscard]] int digits_of(const certificate& c);

/// One increment of a recorded path, with facts about the last call before the increment.
struct increment_record {
  int step, number;
  double s, fraction;
  bool snaps;
  std::vector<event> events;
  std::optional<double> smin = {};  ///< SMIN of the last call; empty before the first call
  bool equal = true;                ///< false: the kernels differed in the last call
  // Empty unless states are recorded [pairs]; see the same members of `increment`:
  std::vector<double> d = {}, pair_force = {};
  std::vector<int> isep = {};
};

/// The end of a step, computed once.
struct solved_step : structure_state {
  /// How the search for this state ended. mechanism: certainly no equilibrium exists, and there is no state.
  path_status status = path_status::not_factored;
  double rcond = 0.0;  ///< reciprocal condition of the equilibrated stiffness; 0 without a factor
  std::optional<certificate> judged = {};         ///< empty if the step did not reach its full load
  std::vector<increment_record> increments = {};  ///< of a recorded path

  /// False if the search found neither an equilibrium nor that none exists.
  [[nodiscard]] bool is_decided() const {
    return status == path_status::solved || status == path_status::mechanism;
  }
};

/// The ends of all steps that a path reached, and how the path ended.
struct solved_path {
  path_end end;
  std::vector<solved_step> steps;
  [[nodiscard]] bool all_certified() const {
    return std::ranges::all_of(steps, [](const solved_step& s) { return s.judged && s.judged->certified; });
  }
};

class certifier;  // contct/proof/certificate.hpp

/// Follows the path of a problem with a new engine named `engine`. `s` is the structure of the problem.
/// `proof`, which may be null, settles the end of each step. After a step that is not solved, only steps from
/// zero are followed. `max_increments`: see increments_allowed. `only`: the steps to follow, from 1, all from
/// zero; empty: all.
[[nodiscard]] solved_path follow(const problem& p, const linear_structure& s, std::string_view engine,
                                 kernel& leader, const std::vector<observer*>& observers,
                                 certifier* proof = nullptr, int max_increments = 0,
                                 const std::set<int>& only = {});

}  // namespace contct
