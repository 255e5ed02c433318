// The state of a path, in the paper's symbols, and the detection of cycles.
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
#include "contct/model/structure.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/solve/engine.hpp"

namespace contct {

/// Watches statuses while nothing moves. The path is deterministic: when a set of statuses returns while D
/// and R* are the same to the last bit, the same toggles follow for ever. Brent's method finds this with one
/// saved set.
class cycle_detector {
 public:
  /// A new step begins.
  void reset() {
    saved_.clear();
    recent_.clear();
  }

  /// Tell of one increment: whether D or R* moved, the statuses after it, and its events.
  /// Returns true when these statuses came before and nothing has moved since.
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

  /// Pairs, from 0, that toggled more than once in the last 200 increments.
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

/// R*, D, d*, and all that belongs to the pairs. Pairs and dofs count from 0, but for ID.
/// Displacements, D and d* among them, are counted from moving faces (count_from_faces): a row of DD and
/// DTEST at which faces move is that of the pairs there, and a pair between two dofs has a row of its own
/// behind those of the structure, with the difference of the two. What leaves the path is the displacement
/// itself.
struct path_state {
  /// `as_listed`: the kernel is called with D and d* over the dofs of the whole structure, and finds its
  /// pairs there by ID, INDOF and NDOFPN, as the listing was; and springs gather their forces increment by
  /// increment. Otherwise the pairs' own D and d* are all that the kernel gets, and ID counts them: a call
  /// then costs no more on a larger structure. All arguments must outlive this object.
  path_state(const linear_structure& structure_of_path, stiffness_engine& e, std::span<observer* const> o,
             bool as_listed)
      : structure(structure_of_path),
        engine(e),
        total(structure.fixed.size()),
        increment(total.size()),
        shape(total.size()),
        d(structure.pairs.size()),
        d_star(structure.pairs.size()),
        s(structure.pairs.size()),
        pair_force(structure.pairs.size()),
        observers_(o),
        as_listed_(as_listed) {
    int own_rows = 0;
    for (const contact_pair& p : structure.pairs) {
      c.push_back(p.face);
      const bool has_own_row = !as_listed || p.other >= 0;  // after those of the structure
      const int before = as_listed ? structure.dofs() : 0;
      id.push_back(has_own_row ? before + ++own_rows : p.node + 1);
      surface.push_back(p.surface);
      status.push_back(p.closed ? in_contact : separated);
    }
    for (std::size_t i = 0; i < pairs(); ++i) at_dof.push_back(structure.dof_of_pair(i));
    if (as_listed) {
      dd_.resize(structure.dofs() + own_rows);
      dtest_.resize(dd_.size());
    }
    sprung = status;
  }
  path_state(const path_state&) = delete;
  path_state& operator=(const path_state&) = delete;

  const linear_structure& structure;
  stiffness_engine& engine;
  int step = 0;                     ///< from 1
  std::vector<double> total;        ///< load at the end of the step [dofs]
  std::vector<double> increment;    ///< total less the previous step's [dofs]
  residual_load residual{};         ///< R*
  std::vector<double> shape;        ///< where steps ended and rigid-body motions led to [dofs]
  std::vector<double> d;            ///< D where each pair acts [pairs]
  std::vector<double> d_star;       ///< d* there [pairs]
  std::vector<double> c;            ///< faces [pairs]
  std::vector<double> s;            ///< scale factors of the last call [pairs]
  std::vector<int> id;              ///< ID, from 1 [pairs]
  std::vector<int> surface;         ///< ISURF [pairs]
  std::vector<int> status;          ///< ISEP [pairs]
  std::vector<int> sprung;          ///< status of each pair in the engine's stiffness [pairs]
  std::vector<double> pair_force;   ///< force on the structure that each spring has gathered [pairs]
  std::vector<std::size_t> at_dof;  ///< dof of each pair [pairs]
  std::vector<event> events;        ///< by which `status` differs from `sprung`
  std::vector<int> last_opened;     ///< pairs separated by the step's last increment that separated any
  cycle_detector cycles;

  [[nodiscard]] std::size_t pairs() const { return status.size(); }

  /// The share of the step's load increment applied by now.
  [[nodiscard]] double fraction() const { return 1.0 - residual.share; }

  /// R* becomes the load of step `number` less the previous one's.
  void begin_step(int number, const load_history& total_load) {
    step = number;
    moved_.clear();
    if (total_load.from_zero(step)) unload();
    for (std::size_t i = 0; i < total.size(); ++i) increment[i] = -total[i];
    std::fill(total.begin(), total.end(), 0.0);
    total_load(step, total);
    for (std::size_t i = 0; i < total.size(); ++i) increment[i] += total[i];
    moved_before_ = total_load.moved_before(step, total.size());
    moved_ = total_load.moved(step, total.size());
    residual = {increment, 1.0, residual.version + 1};
    last_opened.clear();
    cycles.reset();
    loads_ = &total_load;
  }

  /// Back to the state before any load: D, ISEP and what springs have gathered.
  void unload() {
    for (std::vector<double>* const all : {&total, &shape, &pair_force}) std::ranges::fill(*all, 0.0);
    std::vector<int> isep;
    for (const contact_pair& p : structure.pairs) isep.push_back(p.closed ? in_contact : separated);
    put_at(shape, isep);
  }

  /// The rigid-body motion that the residual load drives and that nothing stops now; nothing if it drives
  /// none.
  [[nodiscard]] std::optional<free_motion> driven_motion() const {
    const rigid_work work = loads_->work(step);
    return structure.driven_motion(held_by(), increment,
                                   loads_->from_zero(step) ? work : work.less(loads_->work(step - 1)));
  }

  /// Is there an equilibrium at the end of the step? If so, there is one throughout the step. Nothing if only
  /// rounding would decide.
  [[nodiscard]] std::optional<bool> has_equilibrium() const {
    return structure.has_equilibrium(loads_->work(step));
  }

  /// Does the step's total load drive what nothing stops now? Nothing if only rounding would decide.
  [[nodiscard]] std::optional<bool> total_drives_a_motion() const {
    const rigid_work work = loads_->work(step);
    if (!work.is_known()) return std::nullopt;
    return structure.driven_motion(held_by(), total, work).has_value();
  }

  /// Put one call to the kernel, with `d_test` [pairs] for d*, and tell the observers. Sets s, status and
  /// events; returns s_min. Throws no_factor when d* is not finite.
  double ask(kernel& leader, std::span<const double> d_test) {
    if (!std::ranges::all_of(d_star, [](double moves) { return std::isfinite(moves); }))
      throw no_factor("the response to the residual load is not finite");
    call<double> arguments{d, d_test, c, s, 0.0, id, status, surface, {}};
    if (as_listed_) {
      for (std::size_t i = 0; i < pairs(); ++i) {
        const bool has_own_row = structure.pairs[i].other >= 0;  // a matrix: one dof a node
        const std::size_t row = has_own_row ? id[i] - std::size_t{1} : at_dof[i];
        dd_[row] = d[i];
        dtest_[row] = d_test[i];
      }
      arguments.dd = dd_;
      arguments.dtest = dtest_;
      arguments.dof = {structure.deflection + 1, structure.dofs_per_node};
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

  /// The events of statuses that something else than the kernel has set.
  void find_events() {
    events.clear();
    for (std::size_t i = 0; i < pairs(); ++i)
      if (status[i] != sprung[i])
        events.push_back({static_cast<int>(i), status[i] == in_contact ? change::make : change::break_});
  }

  /// D <- D + s_min d*. False when nothing moved to the last bit and no load was applied.
  bool advance(double s_min) {
    for (std::size_t i = 0; as_listed_ && i < pairs(); ++i)
      if (sprung[i] == in_contact) pair_force[i] -= structure.pairs[i].stiffness * (s_min * d_star[i]);
    const bool consumes = 1.0 - s_min != 1.0;
    bool moved = consumes;
    for (std::size_t i = 0; !consumes && i < pairs(); ++i) moved |= d[i] + s_min * d_star[i] != d[i];
    for (std::size_t i = 0; i < pairs(); ++i) d[i] += s_min * d_star[i];
    return moved;
  }

  /// Switch the springs of the pairs whose events these are.
  void switch_springs() {
    for (const event& e : events) engine.switch_spring(e.pair, e.what == change::make);
    if (std::vector<int> pairs = opened(); !pairs.empty()) last_opened = std::move(pairs);
    sprung = status;
  }

  /// The movement of the faces at a dof when that share of the step's load is still to be applied.
  [[nodiscard]] double moved(std::size_t dof, double share_left) const {
    if (moved_.empty()) return 0.0;
    const double before = moved_before_.empty() ? 0.0 : moved_before_[dof];
    return moved_[dof] - share_left * (moved_[dof] - before);
  }

  /// `v` [dofs], counted from the faces, becomes the displacement under the load applied so far.
  void to_displacement(std::span<double> v) const {
    for (std::size_t dof = 0; dof < v.size(); ++dof) v[dof] += moved(dof, residual.share);
  }

  /// At the end of the step the displacement where the pairs act is `u` [dofs], and their statuses are `isep`
  /// [pairs].
  void put_at(std::span<const double> u, std::span<const int> isep) {
    for (std::size_t i = 0; i < pairs(); ++i) d[i] = structure.seen_by_pair(i, u) - moved(at_dof[i], 0.0);
    status.assign(isep.begin(), isep.end());
    find_events();
    switch_springs();
  }

  /// The rigid-body motions that supports and pairs in contact stop, and whether these are all.
  [[nodiscard]] rigid_rank held_by() const { return held_by(status); }
  [[nodiscard]] rigid_rank held_by(const std::vector<int>& isep) const {
    return structure.held_by([&isep](std::size_t i) { return isep[i] == in_contact; });
  }
  [[nodiscard]] bool held() const { return structure.is_held(held_by()); }

  /// The pairs that these events separate.
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

  /// The part of the springs' forces on the structure that does not depend on D [pairs]: as listed each with
  /// the force that it has gathered, whatever its law says; otherwise by its law, k c.
  [[nodiscard]] std::vector<double> spring_forces() const {
    std::vector<double> forces = pair_force;
    for (std::size_t i = 0; i < pairs(); ++i) {
      const double k = structure.pairs[i].stiffness;
      if (sprung[i] == in_contact) forces[i] = as_listed_ ? pair_force[i] + k * d[i] : k * c[i];
    }
    return forces;
  }

  /// The structure moved by `s_min` of this rigid-body motion, and pairs that made contact are at their
  /// faces.
  void move_shape(double s_min, std::span<const double> motion) {
    for (std::size_t dof = 0; dof < shape.size(); ++dof) shape[dof] += s_min * motion[dof];
    for (const event& e : events)
      if (structure.pairs[e.pair].other < 0) shape[at_dof[e.pair]] = c[e.pair];
  }

  /// Tell the observers.
  void tell_increment(int number, double s_min, bool rigid) const {
    for (observer* o : observers_)
      o->incremented({step, number, s_min, fraction(), events, rigid, d, status, pair_force});
  }
  void tell_end(const step_state& end) {
    shape.assign(end.displacement.begin(), end.displacement.end());
    const double share_left = end.fraction == 1.0 ? 0.0 : residual.share;
    for (std::size_t dof = 0; dof < shape.size(); ++dof) shape[dof] -= moved(dof, share_left);
    for (observer* o : observers_) o->step_ended(end);
  }

 private:
  const load_history* loads_ = nullptr;
  std::vector<double> moved_before_, moved_;  // faces, at the step's start and end; empty: nowhere [dofs]
  std::span<observer* const> observers_;
  std::int64_t calls_ = 0;
  bool as_listed_;
  std::vector<double> dd_, dtest_;  // D and d* over the structure, where the kernel is called so [dofs]
};

}  // namespace contct
