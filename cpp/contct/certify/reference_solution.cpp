#include "contct/certify/reference_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "contct/matrix/cholesky.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace contct {
namespace {

constexpr int most_iterations = 500;
constexpr int most_refinements = 40;
constexpr long double good_enough = 1e-7L;  // the largest relative correction of an accepted answer
constexpr long double finest = std::numeric_limits<long double>::epsilon();

/// Sets y = -K x.
void multiply_minus(const stiffness_matrix& k, const std::vector<long double>& x,
                    std::vector<long double>& y) {
  std::fill(y.begin(), y.end(), 0.0L);
  k.subtract_product(std::span<const long double>(x), y);
}

long double dot(const std::vector<long double>& a, const std::vector<long double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0L);
}

}  // namespace

class reference_solver::search {
 public:
  explicit search(const linear_structure& s)
      : structure_(s),
        sparse_(entries_for(s, quickest_factor(s))),
        stiffness_(sparse_ ? *sparse_ : s.stiffness),
        load_(s.dofs()),
        u_(s.dofs()),
        set_(s.pairs.size()),
        factor_(quickest_factor(s) == factored_by::cholmod ? stiffness_ : s.stiffness) {
    for (std::size_t i = 0; i < s.pairs.size(); ++i)
      pair_rows_.push_back({s.row_of(s.dof_of_pair(i)), s.pairs[i].stiffness,
                            s.pairs[i].other < 0 ? -1 : s.row_of(s.other_of_pair(i))});
    start_undeformed();
    for (int row = 0; row < s.dofs(); ++row) scale_.push_back(std::sqrt(s.stiffness.diagonal(row)));
  }

  reference_answer solve(std::span<const double> load, const rigid_work& work) {
    take(load, work);
    if (exists_ == false) return end(outcome::no_equilibrium, false);
    reference_answer answer = from_here();
    if (answer.how == outcome::found) return answer;
    // Rounding may be too large if the last answer is far from the new one: starts from the undeformed
    // structure.
    start_undeformed();
    settle();
    answer = from_here();
    if (answer.how != outcome::found) start_undeformed();
    return answer;
  }

  void start_undeformed() {
    std::fill(u_.begin(), u_.end(), 0.0L);
    for (std::size_t i = 0; i < set_.size(); ++i) set_[i] = structure_.pairs[i].closed ? 1 : 0;
  }

  double reciprocal_condition() {
    if (!in_factor_) return 0.0;
    return contct::reciprocal_condition(stiffness_, stiffness_.diagonal_with(*in_factor_),
                                        [this](std::span<double> b) { factor_.solve(b); });
  }

  [[nodiscard]] int factorisations() const { return factorisations_; }

 private:
  using numbers = std::vector<long double>;
  using pair_set = std::vector<char>;
  using outcome = reference_answer::outcome;
  struct holding_spring {
    std::size_t row;
    double stiffness;
    long double rest;
  };

  void take(std::span<const double> load, const rigid_work& work) {
    given_.assign(load.begin(), load.end());
    work_ = work;
    exists_ = structure_.has_equilibrium(work);
    for (std::size_t dof = 0; dof < load.size(); ++dof)
      load_[structure_.row_of(dof)] = structure_.in_row(dof, load[dof]);
    long double whole = 0.0L;
    for (int dof = structure_.deflection; dof < structure_.dofs(); dof += structure_.dofs_per_node)
      if (structure_.fixed[dof] == 0) whole += std::abs(load_[structure_.row_of(dof)]);
    largest_load_ = std::max(largest_load_, whole);
    settle();
  }

  /// Sets prescribed displacements, which the search does not change.
  void settle() {
    for (std::size_t dof = 0; dof < structure_.settles.size(); ++dof) {
      const int row = structure_.row_of(dof);
      if (structure_.settles[dof] != 0) u_[row] = load_[row] / structure_.stiffness.diagonal(row);
    }
  }

  /// The pairs with n (w - c) > 0; a pair within `tie` of its face keeps its status.
  [[nodiscard]] pair_set pressed_at(const numbers& u, long double tie) const {
    pair_set set = set_;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const contact_pair& p = structure_.pairs[i];
      const long double pressing = p.surface * (pair_rows_[i].stretch(u) - p.face);
      if (!(std::abs(pressing) <= tie)) set[i] = pressing > 0.0L ? 1 : 0;
    }
    return set;
  }

  [[nodiscard]] rigid_rank held_by(const pair_set& set) const {
    return structure_.held_by([&set](std::size_t i) { return set[i] != 0; });
  }

  /// Do the supports and the pairs whose force exceeds the rounding of the load hold the structure? If not,
  /// other displacements are equilibria too: the structure lies on its faces without load, or balances.
  [[nodiscard]] bool holds_firmly() const {
    constexpr long double rounding = 1e-12L;
    pair_set firm(set_.size());
    for (std::size_t i = 0; i < firm.size(); ++i) {
      const contact_pair& p = structure_.pairs[i];
      firm[i] =
          p.stiffness * p.surface * (pair_rows_[i].stretch(u_) - p.face) > rounding * largest_load_ ? 1 : 0;
    }
    return structure_.is_held(held_by(firm));
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

  /// Sets r to the load less K u and the forces of all springs; to 0 in rows of fixed dofs.
  void residual(const numbers& u, numbers& r) const {
    multiply_minus(stiffness_, u, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += load_[i];
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const contact_pair& p = structure_.pairs[i];
      if (set_[i] == 0) continue;
      const long double spring = p.stiffness * (pair_rows_[i].stretch(u) - p.face);
      r[pair_rows_[i].row] -= spring;
      if (pair_rows_[i].other >= 0) r[pair_rows_[i].other] += spring;
    }
    for (const holding_spring& h : holding_) r[h.row] -= h.stiffness * (u[h.row] - h.rest);
    for (int dof = 0; dof < structure_.dofs(); ++dof)
      if (structure_.fixed[dof] != 0) r[structure_.row_of(dof)] = 0.0L;
  }

  /// Replaces u by the equilibrium with the springs of the pressed pairs. Returns the largest change at a
  /// pair in the last correction, or a negative number if refinement does not converge. If other pairs are
  /// pressed at the new u, it only gives a direction, so it is not refined to its last digit.
  long double refined_solve(numbers& u) {
    numbers r(u.size());
    std::vector<double> step(u.size());
    long double before = std::numeric_limits<long double>::infinity();
    long double size = 0.0L;  // the largest scaled u so far, so that an answer of 0 is accepted
    for (std::size_t i = 0; i < u.size(); ++i) size = std::max(size, scale_[i] * std::abs(u[i]));
    for (int pass = 0; pass < most_refinements; ++pass) {
      residual(u, r);
      for (std::size_t i = 0; i < r.size(); ++i) step[i] = static_cast<double>(r[i]);
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
  /// where a pair meets its face. Infinite if E decreases without limit.
  [[nodiscard]] long double best_step(const numbers& p) const {
    numbers minus_kp(p.size());
    multiply_minus(stiffness_, p, minus_kp);
    return best_step(p, -dot(minus_kp, u_) - dot(load_, p), -dot(minus_kp, p));
  }
  /// The same alpha. `slope`: the slope of E at alpha = 0, without the part of the pairs; `growth`: the
  /// derivative of this slope.
  [[nodiscard]] long double best_step(const numbers& p, long double slope, long double growth) const {
    struct bend {
      long double at, slope, growth;
    };
    std::vector<bend> bends;
    for (std::size_t i = 0; i < pair_rows_.size(); ++i) {
      const contact_pair& c = structure_.pairs[i];
      const long double w = pair_rows_[i].stretch(u_);
      const long double dw = pair_rows_[i].stretch(p);
      const bool pressed = c.surface * (w - c.face) > 0;
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

  /// The outcome if E falls without limit along p: none_seen; not_found if an equilibrium exists, supports
  /// hold the structure or p is not finite, so that only rounding makes E fall.
  [[nodiscard]] outcome why_endless(const numbers& p) const {
    if (exists_ == true || structure_.is_held(held_by(pair_set(set_.size())))) return outcome::not_found;
    const bool finite = std::all_of(p.begin(), p.end(), [](long double x) { return std::isfinite(x); });
    return finite ? outcome::none_seen : outcome::not_found;
  }

  [[nodiscard]] reference_answer end(outcome how, bool unique) const {
    reference_answer answer{how, unique, {}, set_};
    for (int dof = 0; dof < structure_.dofs(); ++dof)
      answer.displacement.push_back(static_cast<double>(u_[structure_.row_of(dof)]));
    return answer;
  }

  reference_answer from_here() {
    numbers p(u_.size());
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      rigid_rank rank = held_by(set_);
      const bool held = structure_.is_held(rank);
      holding_.clear();
      const std::optional<free_motion> driven =
          held ? std::nullopt : structure_.driven_motion(rank, given_, work_);
      if (!driven) {
        if (!held) add_holding_springs(rank);
        if (!factor()) return end(outcome::not_found, held);
        numbers target = u_;
        const long double error = refined_solve(target);
        if (error >= 0 && pressed_at(target, 4 * error) == set_) {
          u_ = target;
          return end(outcome::found, held && holds_firmly());
        }
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = target[i] - u_[i];
      } else {
        put(*driven, p);
        // If an equilibrium exists, rounding has led to wrong pairs.
        if (nothing_stops(p)) return end(exists_ == true ? outcome::not_found : outcome::none_seen, false);
      }
      const long double alpha = driven ? best_step(p, -driven->work, 0.0L) : best_step(p);
      if (!std::isfinite(alpha)) return end(why_endless(p), false);
      for (std::size_t i = 0; i < p.size(); ++i) u_[i] += alpha * p[i];
      set_ = pressed_at(u_, 0.0L);
    }
    return end(outcome::not_found, false);
  }

  const linear_structure& structure_;
  const std::optional<stiffness_matrix> sparse_;
  const stiffness_matrix& stiffness_;
  std::vector<spring_at> pair_rows_;     // [pairs]
  numbers load_;                         // [rows]
  std::vector<double> given_;            // the load as passed by the caller [dofs]
  rigid_work work_;                      // work of the load on each rigid-body motion
  std::optional<bool> exists_;           // has the load an equilibrium? empty: not decided exactly
  std::vector<holding_spring> holding_;  // the added springs without force of the present iteration
  long double largest_load_ = 0.0L;      // the largest sum of the magnitudes of a load's forces so far
  numbers u_;                            // the present point; at the end the answer [rows]
  pair_set set_;                         // [pairs] 1 if the pair is pressed at u_
  stiffness_factor factor_;
  std::optional<std::vector<spring_at>> in_factor_;  // the springs in the factor; empty if factoring failed
  std::vector<double> scale_;                        // sqrt(K_ii) [rows]
  int factorisations_ = 0;
};

reference_solver::reference_solver(const linear_structure& s) : search_(std::make_unique<search>(s)) {}
reference_solver::~reference_solver() = default;

void reference_solver::start_undeformed() {
  search_->start_undeformed();
}

reference_answer reference_solver::solve(std::span<const double> load, const rigid_work& work) {
  return search_->solve(load, work);
}

double reference_solver::reciprocal_condition() {
  return search_->reciprocal_condition();
}

int reference_solver::factorisations() const {
  return search_->factorisations();
}

}  // namespace contct
