// The state of a path, in the symbols of the paper, and the detection of cycles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/kernel/kernel.hpp"
#include "contct/linear/engine.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/path/structure_state.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// Detects cycles of statuses. The path is deterministic: if all statuses return while D and R* are the same
/// to the bit, the same toggles follow for ever. Brent's method detects this with one saved set of statuses.
class cycle_detector {
 public:
  void reset() {
    saved_.clear();
    recent_.clear();
  }

  /// Adds an increment with its `events`. `moved`: the increment changed D or R*; `status`: the statuses
  /// after the increment. Returns true if these statuses occurred before, and D and R* have not changed
  /// since.
  bool repeats(bool moved, std::span<const int> status, std::span<const event> events) {
    recent_.emplace_back(events.begin(), events.end());
    if (recent_.size() > remembered_increments) recent_.pop_front();
    if (moved) {
      saved_.clear();
      return false;
    }
    if (std::ranges::equal(status, saved_)) return !saved_.empty();
    if (saved_.empty() || ++steps_since_saved_ == next_save_) {
      next_save_ = saved_.empty() ? 1 : 2 * next_save_;
      steps_since_saved_ = 0;
      saved_.assign(status.begin(), status.end());
    }
    return false;
  }

  /// The pairs, from 0, that toggled more than once in the last 200 increments.
  [[nodiscard]] std::vector<int> restless_pairs() const {
    std::map<int, int> toggles;
    for (const std::vector<event>& events : recent_)
      for (const event& e : events) ++toggles[e.pair];
    std::vector<int> pairs;
    for (const auto& [pair, times] : toggles)
      if (times > 1) pairs.push_back(pair);
    return pairs;
  }

 private:
  static constexpr std::size_t remembered_increments = 200;
  std::vector<int> saved_;
  long steps_since_saved_ = 0;
  long next_save_ = 1;
  std::deque<std::vector<event>> recent_;
};

/// R*, D, d* and the data of pairs. Pairs and dofs count from 0; ID counts from 1.
/// D, d* and other displacements are relative to moving faces (right_hand_side), but observers receive
/// absolute displacements at the end of a step. For the listing, a pair between two dofs has an additional
/// row of DD and DTEST, after the structure's rows, with the difference of the two dofs.
struct path_state {
  /// If `as_listed`, the kernel receives D and d* of the whole structure, in which ID, INDOF and NDOFPN
  /// address the pairs, as in the listing; spring forces are summed over increments. Otherwise the kernel
  /// receives only the D and d* of the pairs, and ID is the number of the pair, so that the cost of a call
  /// does not grow with the structure. All arguments must outlive this object.
  path_state(const linear_structure& structure_of_path, const load_history& loads, stiffness_engine& e,
             std::span<observer* const> o, bool as_listed)
      : structure(structure_of_path),
        engine(e),
        total(structure.fixed.size()),
        increment(total.size()),
        shape(total.size()),
        d(structure.pairs.size()),
        d_star(structure.pairs.size()),
        s(structure.pairs.size()),
        status(statuses_at_start(structure.pairs)),
        sprung(status),
        pair_force(structure.pairs.size()),
        loads_(loads),
        observers_(o),
        as_listed_(as_listed) {
    int own_rows = 0;
    for (const pair_in<double>& p : structure.pairs) {
      c.push_back(p.face);
      const bool has_own_row = !as_listed || p.other >= 0;  // after the structure's rows
      const int before = as_listed ? structure.dofs() : 0;
      id.push_back(has_own_row ? before + ++own_rows : p.dof / structure.dofs_per_node + 1);
      surface.push_back(p.surface);
    }
    for (std::size_t i = 0; i < pairs(); ++i) at_dof.push_back(structure.pairs[i].dof);
    if (as_listed) {
      dd_.resize(structure.dofs() + own_rows);
      dtest_.resize(dd_.size());
    }
  }
  path_state(const path_state&) = delete;
  path_state& operator=(const path_state&) = delete;

  const linear_structure& structure;
  stiffness_engine& engine;
  int step = 0;                     ///< from 1
  std::vector<double> total;        ///< load at the end of the step [dofs]
  std::vector<double> increment;    ///< total minus the previous step's total [dofs]
  residual_load residual{};         ///< R*
  std::vector<double> shape;        ///< displacements after the last step and later rigid-body motions [dofs]
  std::vector<double> d;            ///< D where each pair acts [pairs]
  std::vector<double> d_star;       ///< d* where each pair acts [pairs]
  std::vector<double> c;            ///< faces [pairs]
  std::vector<double> s;            ///< scale factors of the last call [pairs]
  std::vector<int> id;              ///< ID, from 1 [pairs]
  std::vector<int> surface;         ///< ISURF [pairs]
  std::vector<int> status;          ///< ISEP [pairs]
  std::vector<int> sprung;          ///< status of each pair in the engine's stiffness [pairs]
  std::vector<double> pair_force;   ///< force of each spring on the structure, summed over increments [pairs]
  std::vector<std::size_t> at_dof;  ///< dof of each pair [pairs]
  std::vector<event> events;        ///< the differences of `status` from `sprung`
  std::vector<int> last_opened;     ///< pairs of the last separation in this step
  cycle_detector cycles;

  [[nodiscard]] std::size_t pairs() const { return status.size(); }

  /// The share of the step's load increment applied so far.
  [[nodiscard]] double fraction() const { return 1.0 - residual.share; }

  /// Sets R* to the load of step `number` minus the previous load.
  void begin_step(int number) {
    step = number;
    moved_.clear();
    if (loads_.from_zero(step)) unload();
    const std::vector<double> before = std::exchange(total, loads_.total(step));
    for (std::size_t i = 0; i < total.size(); ++i) increment[i] = total[i] - before[i];
    moved_before_ = loads_.moved_before(step);
    moved_ = loads_.moved(step);
    residual = {increment, 1.0, residual.version + 1};
    last_opened.clear();
    cycles.reset();
  }

  /// Resets D, ISEP and the spring forces to the state before any load.
  void unload() {
    for (std::vector<double>* const all : {&total, &shape, &pair_force}) std::ranges::fill(*all, 0.0);
    put_at(shape, statuses_at_start(structure.pairs));
  }

  /// The rigid-body motion that supports and contacts leave free and on which the residual load does work;
  /// nothing if no such motion exists.
  [[nodiscard]] std::optional<free_motion> driven_motion() const {
    const rigid_work work = loads_.work(step);
    return structure.driven_motion(
        held_by(), increment, loads_.from_zero(step) ? work : difference_of(work, loads_.work(step - 1)));
  }

  /// True if an equilibrium exists at the end of the step, and therefore throughout the step. Nothing if only
  /// rounding would decide.
  [[nodiscard]] std::optional<bool> has_equilibrium() const {
    return structure.has_equilibrium(loads_.work(step));
  }

  /// True if the step's total load does work on a rigid-body motion that supports and contacts leave free.
  /// Nothing if only rounding would decide.
  [[nodiscard]] std::optional<bool> total_drives_a_motion() const {
    const rigid_work work = loads_.work(step);
    if (!work) return std::nullopt;
    return structure.driven_motion(held_by(), total, work).has_value();
  }

  /// Calls the kernel with `d_test` [pairs] as d*, and notifies the observers. Sets s, status and events;
  /// returns s_min. Throws no_factor if d* is not finite.
  double ask(kernel& leader, std::span<const double> d_test) {
    if (!std::ranges::all_of(d_star, [](double moves) { return std::isfinite(moves); }))
      throw no_factor("the response to the residual load is not finite");
    call<double> arguments{d, d_test, c, s, 0.0, id, status, surface, {}};
    if (as_listed_) {
      for (std::size_t i = 0; i < pairs(); ++i) {
        // A pair between two dofs exists only in a matrix, in which each node has one dof.
        const bool has_own_row = structure.pairs[i].other >= 0;
        const std::size_t row = has_own_row ? id[i] - std::size_t{1} : at_dof[i];
        dd_[row] = d[i];
        dtest_[row] = d_test[i];
      }
      arguments.dd = dd_;
      arguments.dtest = dtest_;
      arguments.dof = {1, structure.dofs_per_node};
    }
    leader.answer(arguments);
    find_events();
    const std::string text = leader.take_text();
    residual.last_s = s;
    const answered_call answered{
        arguments, sprung, leader.facts().has_text ? std::optional<std::string_view>(text) : std::nullopt,
        ++calls_};
    for (observer* o : observers_) o->called(answered);
    return arguments.smin;
  }

  /// Sets `events` to the differences of `status` from `sprung`.
  void find_events() {
    events.clear();
    for (std::size_t i = 0; i < pairs(); ++i)
      if (status[i] != sprung[i])
        events.push_back({static_cast<int>(i), status[i] == in_contact ? change::make : change::break_});
  }

  /// D <- D + s_min d*. Returns false if D is the same to the bit and no load was applied.
  bool advance(double s_min) {
    for (std::size_t i = 0; as_listed_ && i < pairs(); ++i)
      if (sprung[i] == in_contact) pair_force[i] -= structure.pairs[i].stiffness * (s_min * d_star[i]);
    const bool consumes = 1.0 - s_min != 1.0;
    bool moved = consumes;
    for (std::size_t i = 0; !consumes && i < pairs(); ++i) moved |= d[i] + s_min * d_star[i] != d[i];
    for (std::size_t i = 0; i < pairs(); ++i) d[i] += s_min * d_star[i];
    return moved;
  }

  /// Inserts or removes the springs of the pairs in `events`.
  void switch_springs() {
    for (const event& e : events) engine.switch_spring(e.pair, e.what == change::make);
    if (std::vector<int> pairs = opened(); !pairs.empty()) last_opened = std::move(pairs);
    sprung = status;
  }

  /// The movement of the faces at a dof when the share `share_left` of the step's load is not applied yet.
  [[nodiscard]] double moved(std::size_t dof, double share_left) const {
    if (moved_.empty()) return 0.0;
    const double before = moved_before_.empty() ? 0.0 : moved_before_[dof];
    return moved_[dof] - share_left * (moved_[dof] - before);
  }

  /// Makes displacements `v` [dofs], which are relative to the faces, absolute under the load applied so far.
  void to_displacement(std::span<double> v) const {
    for (std::size_t dof = 0; dof < v.size(); ++dof) v[dof] += moved(dof, residual.share);
  }

  /// Sets D and ISEP to the state at the end of the step: displacements `u` [dofs], statuses `isep` [pairs].
  void put_at(std::span<const double> u, std::span<const int> isep) {
    for (std::size_t i = 0; i < pairs(); ++i) d[i] = structure.pairs[i].seen_in(u) - moved(at_dof[i], 0.0);
    status.assign(isep.begin(), isep.end());
    find_events();
    switch_springs();
  }

  /// The rigid-body motions that supports and pairs in contact stop.
  [[nodiscard]] rigid_rank held_by() const { return held_by(status); }
  [[nodiscard]] rigid_rank held_by(const std::vector<int>& isep) const {
    return structure.held_by([&isep](std::size_t i) { return isep[i] == in_contact; });
  }
  [[nodiscard]] bool held() const { return structure.is_held(held_by()); }

  /// The pairs that `events` separate.
  [[nodiscard]] std::vector<int> opened() const {
    std::vector<int> open;
    for (const event& e : events)
      if (e.what == change::break_) open.push_back(e.pair);
    return open;
  }

  /// The load applied so far [dofs].
  [[nodiscard]] std::vector<double> applied_load() const {
    std::vector<double> applied(total.size());
    for (std::size_t i = 0; i < applied.size(); ++i) applied[i] = total[i] - residual.share * increment[i];
    return applied;
  }

  /// The part of the spring forces on the structure that does not depend on D [pairs]: k c by the spring's
  /// law. If `as_listed`, the summed force replaces the law.
  [[nodiscard]] std::vector<double> spring_forces() const {
    std::vector<double> forces = pair_force;
    for (std::size_t i = 0; i < pairs(); ++i) {
      const double k = structure.pairs[i].stiffness;
      if (sprung[i] == in_contact) forces[i] = as_listed_ ? pair_force[i] + k * d[i] : k * c[i];
    }
    return forces;
  }

  /// Moves the structure by `s_min` times `motion`, and puts pairs that made contact at their faces.
  void move_shape(double s_min, std::span<const double> motion) {
    for (std::size_t dof = 0; dof < shape.size(); ++dof) shape[dof] += s_min * motion[dof];
    for (const event& e : events)
      if (structure.pairs[e.pair].other < 0) shape[at_dof[e.pair]] = c[e.pair];
  }

  void tell_increment(int number, double s_min, bool rigid) const {
    for (observer* o : observers_)
      o->incremented({step, number, s_min, fraction(), events, rigid, d, status, pair_force});
  }
  /// Stores the displacements at the end of the step, relative to the faces.
  void keep_shape(const structure_state& end) {
    shape = end.displacement;
    const double share_left = end.fraction == 1.0 ? 0.0 : residual.share;
    for (std::size_t dof = 0; dof < shape.size(); ++dof) shape[dof] -= moved(dof, share_left);
  }

 private:
  const load_history& loads_;
  std::vector<double> moved_before_, moved_;  // movements of faces at the start and end of the step [dofs]
  std::span<observer* const> observers_;
  std::int64_t calls_ = 0;
  bool as_listed_;
  std::vector<double> dd_, dtest_;  // D and d* of the whole structure, if `as_listed` [dofs]
};

}  // namespace contct
