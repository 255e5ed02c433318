// Where a path stands, in the paper's words.
#pragma once

#include <span>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/path/observer.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// D, d*, and all that belongs to the pairs. Pairs and dofs count from 0, but for `node`.
struct path_state {
  /// `as_listed`: the kernel is called with D and d* over the dofs of the whole structure, and finds its
  /// pairs there by ID, INDOF and NDOFPN, as the listing was. Otherwise the pairs' own are all it gets, and
  /// ID counts them: a call then costs no more on a larger structure.
  path_state(const linear_structure& s, bool as_listed);

  const linear_structure& structure;
  std::vector<double> d;                 ///< D where each pair acts [pairs]
  std::vector<double> d_star;            ///< d* there [pairs]
  std::vector<double> c;                 ///< faces [pairs]
  std::vector<double> s;                 ///< scale factors of the last call [pairs]
  std::vector<int> id;                   ///< ID, from 1 [pairs]
  std::vector<int> surface;              ///< ISURF [pairs]
  std::vector<int> status;               ///< ISEP [pairs]
  std::vector<int> sprung;               ///< status of each pair in the engine's stiffness [pairs]
  std::vector<double> pair_force;        ///< force on the structure that each spring has gathered [pairs]
  std::vector<std::size_t> at_dof;       ///< dof of each pair [pairs]
  std::vector<std::size_t> first_there;  ///< the first pair at the same dof [pairs]
  std::vector<event> events;             ///< of the last call

  [[nodiscard]] std::size_t pairs() const { return status.size(); }

  /// Put one call to the kernel, with `d_test` [pairs] for d*, and tell the observers. Sets s, status
  /// and events; returns s_min.
  double ask(kernel& leader, std::span<const double> d_test, std::span<observer* const> observers);

  /// Undo the toggles of the last call.
  void take_back_toggles();

  /// D <- D + s_min d*, and with it, where `gathers`, the forces in the springs. False
  /// when nothing moved to the last bit and no load was applied.
  bool advance(double s_min, bool gathers);

  /// The rigid motions that supports and closed pairs stop, and whether these are all.
  [[nodiscard]] rigid_rank held_by() const;
  [[nodiscard]] bool held() const;

  [[nodiscard]] bool response_is_finite() const;

  /// The pairs that the last call opened.
  [[nodiscard]] std::vector<int> opened() const;

  /// The part of the springs' forces on the structure that does not depend on D [pairs]: each with
  /// the force that it has gathered, the 1989 way, whatever its law says; or by its law, k c.
  [[nodiscard]] std::vector<double> forces_gathered() const;
  [[nodiscard]] std::vector<double> forces_by_law() const;

 private:
  void find_events();

  bool as_listed_;
  std::vector<double> dd_, dtest_;  // D and d* over the structure, where the kernel is called so [dofs]
};

}  // namespace contct
