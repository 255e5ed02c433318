// The reference solution: the equilibrium as minimiser of a convex energy, without kernel or path.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contct/linear/cholesky.hpp"
#include "contct/linear/factored_stiffness.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/solved_path.hpp"

namespace contct {

/// Minimises the energy of a structure on one-sided springs,
///
///     E(u) = u'K u / 2 - f'u + sum over pairs of k max(0, n (w - c))^2 / 2,
///
/// which is convex and has a continuous slope: the equilibrium does not depend on the path.
///
/// A primal-dual active set: the set of pressed pairs makes E a quadratic, whose minimiser is the next point.
/// The pairs pressed at that point are the next set. With full steps the sets can cycle, so each step ends at
/// the point along the step where E is least. E is piecewise quadratic along a step, so this point is exact.
///
/// Why the search ends: every step but the last is a Newton step with the positive definite matrix of one of
/// finitely many sets. So E falls, and the points converge to the minimiser u*. Near u* only sets occur whose
/// quadratic has u* as its own minimiser, because a pair that is pressed nearby but not at u* is exactly at
/// its face at u*, and its spring has neither force nor energy. From such a point one full step leads to u*.
/// The search ends when the set of pressed pairs is the same before and after a step.
///
/// If the pressed pairs do not hold the structure, the step is the rigid-body motion on which the load does
/// work. If the load does work on no rigid-body motion, springs without force hold the structure.
///
/// Every solve is refined with residuals in long double, which gives 3 to 4 more digits than a band solver.
class reference_solver {
 public:
  /// `s` must outlive this object.
  explicit reference_solver(const linear_structure& s)
      : structure_(s), u_(s.dofs()), set_(s.pairs.size()), factor_(s.stiffness, quickest_factor(s)) {
    for (std::size_t i = 0; i < s.pairs.size(); ++i) pair_rows_.push_back(s.spring_of(i));
    start_undeformed();
    for (int row = 0; row < s.dofs(); ++row) scale_.push_back(std::sqrt(s.stiffness.diagonal(row)));
  }

  /// Finds the equilibrium under `load` [dofs], starting from the last answer and, if that fails because its
  /// rounding is too large for the new load, from the undeformed structure. `work` of this load, if known,
  /// decides which rigid-body motion the load drives. If the search fails, the state is its last point; there
  /// is no state if certainly no equilibrium exists.
  [[nodiscard]] solved_step solve(std::span<const double> load, const rigid_work& work = {}) {
    given_.assign(load.begin(), load.end());
    work_ = work;
    exists_ = structure_.has_equilibrium(work);
    load_ = in_rows(structure_, load);
    settle();
    if (exists_ == false) return {{}, path_status::mechanism};
    path_status how = from_here();
    if (how != path_status::solved) {
      start_undeformed();
      settle();
      how = from_here();
    }
    solved_step answer{
        {.fraction = 1.0, .displacement = std::vector<double>(u_.size()), .from = origin::reference}, how};
    for (std::size_t dof = 0; dof < u_.size(); ++dof)
      answer.displacement[dof] = static_cast<double>(u_[structure_.row_of(dof)]);
    for (const char pressed : set_) answer.isep.push_back(pressed != 0 ? in_contact : separated);
    if (how != path_status::solved) start_undeformed();
    return answer;
  }

  /// The next solution starts from the undeformed structure.
  void start_undeformed() {
    std::fill(u_.begin(), u_.end(), 0.0L);
    for (std::size_t i = 0; i < set_.size(); ++i) set_[i] = structure_.pairs[i].closed ? 1 : 0;
  }

  /// The reciprocal condition number of K with the springs of the last answer, its diagonal scaled to 1. 0 if
  /// the last factorisation failed.
  [[nodiscard]] double reciprocal_condition() {
    if (!in_factor_) return 0.0;
    return contct::reciprocal_condition(structure_.stiffness, structure_.stiffness.diagonal_with(*in_factor_),
                                        [this](std::span<double> b) { factor_.solve(b); });
  }

  [[nodiscard]] int factorisations() const { return factorisations_; }

 private:
  using numbers = std::vector<long double>;
  using pair_set = std::vector<char>;
  static constexpr int most_iterations = 500, most_refinements = 40;
  static constexpr long double good_enough = 1e-7L;  // the largest relative correction of an accepted answer
  static constexpr long double finest = std::numeric_limits<long double>::epsilon();

  struct holding_spring {
    std::size_t row;
    double stiffness;
    long double rest;
  };

  /// Returns -K x.
  [[nodiscard]] numbers minus_product(const numbers& x) const {
    numbers y(x.size());
    structure_.stiffness.subtract_product(x, y);
    return y;
  }

  template <class Vector>
  [[nodiscard]] static long double dot(const Vector& a, const numbers& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0L);
  }

  /// Sets prescribed displacements, which the search does not change.
  void settle() {
    for (std::size_t dof = 0; dof < structure_.settles.size(); ++dof) {
      const int row = structure_.row_of(dof);
      if (structure_.settles[dof] != 0)
        u_[row] = static_cast<long double>(load_[row]) / structure_.stiffness.diagonal(row);
    }
  }

  /// The pairs with n (w - c) > 0; a pair within `tie` of its face keeps its status.
  [[nodiscard]] pair_set pressed_at(const numbers& u, long double tie) const {
    pair_set set = set_;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const long double pressing = depth_of(structure_.pairs[i], pair_rows_[i].stretch(u));
      if (!(std::abs(pressing) <= tie)) set[i] = pressing > 0.0L ? 1 : 0;
    }
    return set;
  }

  [[nodiscard]] rigid_rank held_by(const pair_set& set) const {
    return structure_.held_by([&set](std::size_t i) { return set[i] != 0; });
  }

  /// True if no separated pair stops this rigid-body motion.
  [[nodiscard]] bool nothing_stops(const numbers& motion) const {
    for (std::size_t i = 0; i < pair_rows_.size(); ++i)
      if (set_[i] == 0 && structure_.pairs[i].surface * pair_rows_[i].stretch(motion) > 0.0L) return false;
    return true;
  }

  void put(const free_motion& motion, numbers& p) const {
    for (int dof = 0; dof < structure_.dofs(); ++dof)
      p[structure_.row_of(dof)] = structure_.fixed[dof] != 0 ? 0.0 : motion.at(dof);
    for (std::size_t i = 0; i < set_.size(); ++i)
      if (set_[i] != 0) p[pair_rows_[i].row] -= pair_rows_[i].stretch(p);  // rounding must not move the pair
  }

  /// Adds springs without force at as many dofs as are needed to hold the structure at its present
  /// displacements.
  void add_holding_springs(rigid_rank& rank) {
    for (int dof = 0; dof < structure_.dofs() && rank.rank() < structure_.rigid_motions; ++dof) {
      const int before = rank.rank();
      if (structure_.fixed[dof] != 0) continue;
      rank.hold(dof);
      if (rank.rank() == before) continue;
      const int row = structure_.row_of(dof);
      holding_.push_back({static_cast<std::size_t>(row), structure_.stiffness.diagonal(row), u_[row]});
    }
  }

  bool factor() {
    std::vector<spring_at> springs = springs_of(structure_, set_);
    for (const holding_spring& h : holding_) springs.push_back({static_cast<int>(h.row), h.stiffness});
    if (in_factor_ && springs == *in_factor_) return true;
    ++factorisations_;
    in_factor_.reset();
    if (factor_.factor(springs)) in_factor_ = std::move(springs);
    return in_factor_.has_value();
  }

  /// The load less K u and the forces of all springs; 0 in rows of fixed dofs.
  [[nodiscard]] numbers residual(const numbers& u) const {
    numbers r = minus_product(u);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += load_[i];
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const pair_in<double>& p = structure_.pairs[i];
      if (set_[i] == 0) continue;
      const long double spring = p.surface * force_of(p, pair_rows_[i].stretch(u), true);
      r[pair_rows_[i].row] -= spring;
      if (pair_rows_[i].other >= 0) r[pair_rows_[i].other] += spring;
    }
    for (const holding_spring& h : holding_) r[h.row] -= h.stiffness * (u[h.row] - h.rest);
    for (int dof = 0; dof < structure_.dofs(); ++dof)
      if (structure_.fixed[dof] != 0) r[structure_.row_of(dof)] = 0.0L;
    return r;
  }

  /// Replaces u by the equilibrium with the springs of the pressed pairs. Returns the largest change at a
  /// pair in the last correction, or a negative number if refinement does not converge. If other pairs are
  /// pressed at the new u, it only gives a direction, so it is not refined to its last digit.
  long double refined_solve(numbers& u) {
    std::vector<double> step(u.size());
    long double before = std::numeric_limits<long double>::infinity();
    long double size = 0.0L;  // the largest scaled u so far, so that an answer of 0 is accepted
    for (std::size_t i = 0; i < u.size(); ++i) size = std::max(size, scale_[i] * std::abs(u[i]));
    for (int pass = 0; pass < most_refinements; ++pass) {
      std::ranges::transform(residual(u), step.begin(), [](long double r) { return static_cast<double>(r); });
      factor_.solve(step);
      long double correction = 0.0L;
      long double largest_step = 0.0L;
      for (std::size_t i = 0; i < u.size(); ++i) {
        u[i] += step[i];
        correction = std::max(correction, static_cast<long double>(scale_[i] * std::abs(step[i])));
        size = std::max(size, scale_[i] * std::abs(u[i]));
      }
      for (const spring_at& at : pair_rows_)
        largest_step = std::max(largest_step, static_cast<long double>(std::abs(at.stretch(step))));
      if (!std::isfinite(correction)) return -1.0L;
      if (pass > 0 && correction <= good_enough * size && pressed_at(u, 4 * largest_step) != set_)
        return largest_step;
      if (correction <= 4 * finest * size || (pass > 1 && correction > before / 2))
        return correction <= good_enough * size ? largest_step : -1.0L;
      before = correction;
    }
    return -1.0L;
  }

  /// The alpha > 0 at which E(u_ + alpha p) is least. The slope of E is piecewise linear in alpha, and kinks
  /// where a pair meets its face. Infinite if E decreases without limit. `driven`: p, if it is a rigid-body
  /// motion.
  [[nodiscard]] long double best_step(const numbers& p, const std::optional<free_motion>& driven) const {
    struct bend {
      long double at, slope, growth;
    };
    long double slope =
        driven ? -driven->work : 0.0L;  // at alpha = 0, at first without the part of the pairs
    long double growth = 0.0L;          // the derivative of the slope
    if (!driven) {
      const numbers minus_kp = minus_product(p);
      slope = -dot(minus_kp, u_) - dot(load_, p);
      growth = -dot(minus_kp, p);
    }
    std::vector<bend> bends;
    for (std::size_t i = 0; i < pair_rows_.size(); ++i) {
      const pair_in<double>& c = structure_.pairs[i];
      const long double w = pair_rows_[i].stretch(u_);
      const long double dw = pair_rows_[i].stretch(p);
      const bool pressed = depth_of(c, w) > 0;
      if (pressed) {
        slope += c.stiffness * dw * (w - c.face);
        growth += c.stiffness * dw * dw;
      }
      const long double at = dw != 0 ? (c.face - w) / dw : -1.0L;
      if (at < 0 || (at == 0 && c.surface * dw <= 0)) continue;
      const int sign = pressed ? -1 : 1;
      bends.push_back({at, sign * c.stiffness * dw * (w - c.face), sign * c.stiffness * dw * dw});
    }
    // The sort is stable, so sums do not depend on the standard library.
    std::stable_sort(bends.begin(), bends.end(), [](const bend& a, const bend& b) { return a.at < b.at; });
    for (const bend& b : bends) {
      if (slope + b.at * growth >= 0) break;
      slope += b.slope;
      growth += b.growth;
    }
    return growth > 0 ? -slope / growth : std::numeric_limits<long double>::infinity();
  }

  /// The end of the search if E falls without limit along p: not_factored if an equilibrium exists, supports
  /// hold the structure or p is not finite, so that only rounding makes E fall.
  [[nodiscard]] path_status why_endless(const numbers& p) const {
    const bool is_rounding = exists_ == true || structure_.is_held(held_by(pair_set(set_.size()))) ||
                             !std::ranges::all_of(p, [](long double x) { return std::isfinite(x); });
    return is_rounding ? path_status::not_factored : path_status::path_ended;
  }

  /// Searches from the present point: solved; path_ended if E falls without limit as far as doubles show;
  /// not_factored if K is too ill-conditioned, or after too many iterations.
  [[nodiscard]] path_status from_here() {
    numbers p(u_.size());
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      rigid_rank rank = held_by(set_);
      const bool held = structure_.is_held(rank);
      holding_.clear();
      const std::optional<free_motion> driven =
          held ? std::nullopt : structure_.driven_motion(rank, given_, work_);
      if (!driven) {
        if (!held) add_holding_springs(rank);
        if (!factor()) return path_status::not_factored;
        numbers target = u_;
        const long double error = refined_solve(target);
        if (error >= 0 && pressed_at(target, 4 * error) == set_) {
          u_ = target;
          return path_status::solved;
        }
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = target[i] - u_[i];
      } else {
        put(*driven, p);
        // If an equilibrium exists, rounding has led to wrong pairs.
        if (nothing_stops(p)) return exists_ == true ? path_status::not_factored : path_status::path_ended;
      }
      const long double alpha = best_step(p, driven);
      if (!std::isfinite(alpha)) return why_endless(p);
      for (std::size_t i = 0; i < p.size(); ++i) u_[i] += alpha * p[i];
      set_ = pressed_at(u_, 0.0L);
    }
    return path_status::not_factored;
  }

  const linear_structure& structure_;
  std::vector<spring_at> pair_rows_;     // [pairs]
  std::vector<double> load_;             // [rows]
  std::vector<double> given_;            // the load as passed by the caller [dofs]
  rigid_work work_;                      // work of the load on each rigid-body motion
  std::optional<bool> exists_;           // has the load an equilibrium? empty: not decided exactly
  std::vector<holding_spring> holding_;  // the added springs without force of the present iteration
  numbers u_;                            // the present point; at the end the answer [rows]
  pair_set set_;                         // [pairs] 1 if the pair is pressed at u_
  stiffness_factor factor_;
  std::optional<std::vector<spring_at>> in_factor_;  // the springs in the factor; empty if factoring failed
  std::vector<double> scale_;                        // sqrt(K_ii) [rows]
  int factorisations_ = 0;
};

/// The reference solution of a problem, step by step. In place of a path, it has the verbs of `path`; the end
/// of a step does not depend on the steps before, because an elastic structure on one-sided springs without
/// friction has no memory.
class reference_path {
 public:
  /// Both arguments must outlive this object.
  reference_path(const problem& p, const linear_structure& s) : loads_(p, s), solver_(s) {}

  /// The end of a step, from 1.
  [[nodiscard]] solved_step end_of(int step) {
    if (loads_.from_zero(step)) solver_.start_undeformed();
    solved_step found = solver_.solve(loads_.total(step), loads_.work(step));
    found.step = step;
    const std::vector<double> moved = loads_.moved(step);
    for (std::size_t dof = 0; dof < std::min(moved.size(), found.displacement.size()); ++dof)
      found.displacement[dof] += moved[dof];
    return found;
  }

  [[nodiscard]] path_end follow(int step) {
    now_.reset();
    solved_step found = end_of(step);
    path_end end{found.status, step, 0.0};
    if (end.status == path_status::mechanism) end.has_equilibrium = false;
    if (end.status == path_status::solved) now_ = static_cast<structure_state&&>(found);
    return end;
  }
  [[nodiscard]] const std::optional<structure_state>& now() const { return now_; }
  [[nodiscard]] double go_on_from(const structure_state& /*s*/) { return solver_.reciprocal_condition(); }
  [[nodiscard]] engine_counts counts() const { return {.factors = solver_.factorisations()}; }

 private:
  load_history loads_;
  reference_solver solver_;
  std::optional<structure_state> now_;
};

}  // namespace contct
