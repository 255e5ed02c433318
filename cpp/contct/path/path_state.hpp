// Where a path stands, in the paper's words.
#pragma once

#include <span>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/solve/engine.hpp"
#include "contct/structure/structure.hpp"

namespace contct::path {

/// R*, D, d*, and all that belongs to the pairs. Pairs and dofs count from 0, but for ID.
struct path_state {
  /// `as_listed`: the kernel is called with D and d* over the dofs of the whole structure, and finds its
  /// pairs there by ID, INDOF and NDOFPN, as the listing was; and springs gather their forces increment by
  /// increment. Otherwise the pairs' own D and d* are all that the kernel gets, and ID counts them: a call
  /// then costs no more on a larger structure. All arguments must outlive this object.
  path_state(const linear_structure& s, stiffness_engine& e, std::span<observer* const> o, bool as_listed);
  path_state(const path_state&) = delete;
  path_state& operator=(const path_state&) = delete;

  const linear_structure& structure;
  stiffness_engine& engine;
  int step = 0;                          ///< from 1
  std::vector<double> total;             ///< load at the end of the step [dofs]
  std::vector<double> increment;         ///< total less the previous step's [dofs]
  residual_load residual{};              ///< R*
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
  std::vector<int> last_opened;          ///< pairs opened by the step's last increment that opened any

  [[nodiscard]] std::size_t pairs() const { return status.size(); }

  /// The share of the step's load increment applied by now.
  [[nodiscard]] double fraction() const { return 1.0 - residual.share; }

  /// R* becomes the load of step `number` less the previous one's.
  void begin_step(int number, const load_history& total_load);

  /// Put one call to the kernel, with `d_test` [pairs] for d* and `at_rest` for call::at_rest, and tell the
  /// observers. Sets s, status and events; returns s_min. Throws no_factor when d* is not finite.
  double ask(kernel& leader, std::span<const double> d_test, int at_rest);

  /// Undo the toggles of the last call.
  void take_back_toggles();

  /// D <- D + s_min d*. False when nothing moved to the last bit and no load was applied.
  bool advance(double s_min);

  /// Switch the springs of the pairs that the last call toggled.
  void switch_springs();

  /// Switch every spring that is not as its pair's status says.
  void adopt_statuses();

  /// The rigid-body motions that supports and pairs in contact stop, and whether these are all.
  [[nodiscard]] rigid_rank held_by() const;
  [[nodiscard]] bool held() const;

  /// The pairs that the last call opened.
  [[nodiscard]] std::vector<int> opened() const;

  /// The load applied so far [dofs].
  [[nodiscard]] std::vector<double> applied_load() const;

  /// The part of the springs' forces on the structure that does not depend on D [pairs]: each with
  /// the force that it has gathered, the 1989 way, whatever its law says; or by its law, k c.
  [[nodiscard]] std::vector<double> forces_gathered() const;
  [[nodiscard]] std::vector<double> forces_by_law() const;

  /// Tell the observers.
  void tell_increment(int number, double s_min, bool rigid) const;
  void tell_end(const step_state& end) const;

 private:
  void find_events();
  [[nodiscard]] bool response_is_finite() const;

  std::span<observer* const> observers_;
  bool as_listed_;
  std::vector<double> dd_, dtest_;  // D and d* over the structure, where the kernel is called so [dofs]
};

}  // namespace contct::path
