#include "contct/certify/error_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/certify/extreme_bounds.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct::certify {
namespace {

std::vector<int> rows_of(const linear_structure& s) {
  std::vector<int> rows(s.dofs());
  for (std::size_t dof = 0; dof < rows.size(); ++dof) rows[dof] = s.row_of(dof);
  return rows;
}

}  // namespace

void by_quantity::take(quantity q, double value) {
  std::optional<double>& largest = (*this)[q];
  largest =
      std::max(largest.value_or(0.0), std::isnan(value) ? std::numeric_limits<double>::infinity() : value);
}

handed_out handed_out_at(const problem& p, const step_state& s) {
  if (s.numbers != nullptr)
    return {s.step,
            s.displacement,
            s.isep,
            s.numbers->pair_forces,
            s.numbers->reactions,
            s.numbers->element_values};
  const load& now = p.steps[s.step - 1];
  handed_out h{s.step,
               s.displacement,
               s.isep,
               {},
               reactions(p, now, s.displacement, s.isep),
               results_in_elements(p.geometry, now, s.displacement).values};
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const double w = s.displacement[std::size_t{1} * p.pairs[i].node * dofs_per_node(p.geometry)];
    h.pair_forces.push_back(force_of(p.pairs[i], w, s.isep[i] == in_contact));
  }
  return h;
}

error_prover::error_prover(const problem& p, const linear_structure& s, exact_residual exactly,
                           semidefinite_test exactly_semidefinite)
    : problem_(p),
      structure_(s),
      true_(true_system_of(p)),
      stiffness_(true_, rows_of(s),
                 s.stiffness.is_band() ? std::optional(s.stiffness.band().subdiagonals()) : std::nullopt),
      exactly_(std::move(exactly)),
      exactly_semidefinite_(std::move(exactly_semidefinite)) {}

double_double error_prover::depth(std::size_t pair, std::span<const double_double> u) const {
  const true_pair& p = true_.pairs[pair];
  return (u[p.dof] - p.face) * p.surface;
}

double error_prover::doubt(std::size_t pair, std::span<const double_double> u) const {
  const true_pair& p = true_.pairs[pair];
  const double size = std::abs(u[p.dof].hi) + std::abs(p.face.hi);
  return size == 0.0 ? 0.0 : 2 * true_rounding * size + 0x1p-1000;  // of underflow
}

bool error_prover::is_certainly_open(std::size_t pair, std::span<const double_double> u, double rho) const {
  return depth(pair, u).hi < -reach_of_pair(pair, u, rho);
}

bool error_prover::has_exact_residual(const true_loads& l) const {
  return exactly_ && l.step > 0 && (closely_ || stiffness_.has_32_digits());
}

/// Are there numbers, or products that the element formulas make of them, for which doubles are too coarse
/// near 0?
bool error_prover::is_below_range(const true_loads& l) const {
  constexpr double least = 1e-280;  // the low halves of 32 digits are numbers too, down to 1e-308
  const auto too_small = [](const double_double& x) { return x.hi != 0.0 && std::abs(x.hi) < least; };
  const auto has_small_pair = [&](const true_pair& p) { return too_small(p.face) || too_small(p.stiffness); };
  const auto has_small_entry = [&](const auto& row) {
    return std::ranges::any_of(row, [&](const auto& entry) { return too_small(entry.second); });
  };
  return true_.least_product < least || std::ranges::any_of(true_.stiffness, has_small_entry) ||
         std::ranges::any_of(true_.pairs, has_small_pair) || std::ranges::any_of(l.force, too_small) ||
         std::ranges::any_of(l.settlement, too_small);
}

void error_prover::put_forces(residual& r) const {
  for (std::size_t dof = 0; dof < true_.dofs(); ++dof) {
    if (r.slack[dof] > 0.0) r.slack[dof] = 2 * true_rounding * r.slack[dof] + 0x1p-1000;  // of underflow
    if (true_.fixed[dof] == 0) r.force[dof] = -r.needed[dof];
  }
}

/// The load less K u and what pairs beyond their faces press with, whatever their statuses.
error_prover::residual error_prover::residual_of(std::span<const double_double> u,
                                                 const true_loads& l) const {
  const std::size_t n = true_.dofs();
  residual r{long_vector(n), std::vector<double>(n), long_vector(n)};
  if (has_exact_residual(l)) {
    if (std::optional<long_vector> exactly = exactly_(l.step, u)) {
      r.needed = std::move(*exactly);
      for (std::size_t dof = 0; dof < n; ++dof)  // one that underflows is not none
        r.slack[dof] = std::max(std::abs(r.needed[dof].hi), std::numeric_limits<double>::min());
      put_forces(r);
      return r;
    }
  }
  for (std::size_t dof = 0; dof < n; ++dof) r.needed[dof] = -l.force[dof];
  r.slack = l.size;
  true_.add_product(u, r.needed, r.slack);
  if (std::ranges::any_of(u, [](const double_double& x) { return x.hi != 0.0; }))
    for (double& size : r.slack)
      size = std::max(size, std::numeric_limits<double>::min());  // it may underflow
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const true_pair& p = true_.pairs[i];
    const double_double deep = depth(i, u);
    const double size = p.stiffness.hi * (std::abs(u[p.dof].hi) + std::abs(p.face.hi));
    if (deep.hi > -true_rounding * (std::abs(u[p.dof].hi) + std::abs(p.face.hi))) r.slack[p.dof] += size;
    if (!(deep.hi <= 0.0)) r.needed[p.dof] += p.stiffness * deep * p.surface;  // what is no number is told
  }
  put_forces(r);
  return r;
}

void error_prover::bound_displacements(const handed_out& state, std::span<const double_double> u,
                                       error_bounds& b) const {
  for (std::size_t dof = 0; dof < true_.dofs(); ++dof) {
    const quantity q = true_.deflects[dof] != 0 ? quantity::w : quantity::slope;
    const double told = std::abs((double_double(state.displacement[dof]) - u[dof]).hi);
    const double moved = true_.fixed[dof] != 0 ? true_rounding * std::abs(u[dof].hi) : reach(dof) * b.rho;
    b.error.take(q, (told + moved) * (1 + summation_slack));
    b.size.take(q, std::abs(state.displacement[dof]));
  }
}

void error_prover::bound_forces(const handed_out& state, std::span<const double_double> u,
                                error_bounds& b) const {
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const true_pair& p = true_.pairs[i];
    const double_double deep = depth(i, u);
    const double_double force = deep.hi <= 0.0 ? double_double(0.0) : p.stiffness * deep;
    const double told = std::abs((double_double(state.pair_forces[i]) - force).hi);
    const double root = std::sqrt(p.stiffness.hi) * (1 + summation_slack);
    const bool held = true_.fixed[p.dof] != 0;
    const bool open = is_certainly_open(i, u, b.rho);
    const double moved = held || open ? 0.0 : std::min(root, p.stiffness.hi * reach(p.dof)) * b.rho;
    const double noise = open ? 0.0 : p.stiffness.hi * doubt(i, u);
    b.error.take(quantity::force, (told + noise + moved) * (1 + summation_slack));
    b.size.take(quantity::force, std::abs(state.pair_forces[i]));
  }
}

/// How far the depth of a pair in any state within rho of u can be from that under u.
double error_prover::reach_of_pair(std::size_t pair, std::span<const double_double> u, double rho) const {
  const int dof = true_.pairs[pair].dof;
  const double moved = true_.fixed[dof] != 0 || rho == 0.0 ? 0.0 : reach(dof) * rho * (1 + summation_slack);
  return moved + doubt(pair, u);
}

/// Each pair's status, and its gap, which is 0 for a pair in contact; the bounds on gaps only where
/// displacements have bounds.
void error_prover::bound_pairs(const handed_out& state, std::span<const double_double> u,
                               error_bounds& b) const {
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const contact_pair& p = problem_.pairs[i];
    const bool is_closed = state.isep[i] == in_contact;
    const double told = gap_of(p, state.displacement[true_.pairs[i].dof], is_closed);
    const double_double gap = -depth(i, u);
    const double reach = reach_of_pair(i, u, b.rho);
    const bool is_wrong =
        is_closed ? gap.hi * (1 - summation_slack) > reach : -gap.hi * (1 - summation_slack) > reach;
    if (is_wrong && !b.wrong_status) b.wrong_status = i;
    if (!b.unique) continue;
    // A pair that presses has no gap, whatever its depth.
    const double least = std::abs((double_double(told) - std::max(gap.hi - reach, 0.0)).hi);
    const double most = std::abs((double_double(told) - std::max(gap.hi + reach, 0.0)).hi);
    b.error.take(quantity::gap, gap.hi > reach
                                    ? std::abs((double_double(told) - gap).hi) * (1 + summation_slack) + reach
                                    : std::max(least, most) * (1 + summation_slack));
    b.size.take(quantity::gap, std::abs(told));
  }
}

/// A dof that is fixed twice gives its reaction to the first support.
std::vector<error_prover::true_reaction> error_prover::reactions_at(std::span<const double_double> u,
                                                                    const residual& r) const {
  const int per_node = dofs_per_node(problem_.geometry);
  std::vector<char> taken(true_.dofs(), 0);
  std::vector<true_reaction> all;
  for (const support& s : problem_.supports) {
    const std::size_t dof = s.node * per_node + s.dof;
    true_reaction& force = all.emplace_back();
    if (!s.fixed) {
      force.force = -(structure::number_of<double_double>(s.spring) * u[dof]);
      force.slack = true_rounding * std::abs(force.force.hi);
      if (true_.fixed[dof] == 0)
        force.per_rho = std::min(std::sqrt(s.spring) * (1 + summation_slack), s.spring * reach(dof));
    } else if (s.fixed && taken[dof] == 0) {
      taken[dof] = 1;
      force = {r.needed[dof], r.slack[dof], true_.root[dof]};
    }
  }
  return all;
}

void error_prover::bound_reactions(const handed_out& state, const residual& r,
                                   std::span<const double_double> u, error_bounds& b) const {
  const std::vector<true_reaction> all = reactions_at(u, r);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const quantity q = problem_.supports[i].dof == 0 ? quantity::reaction : quantity::moment;
    const double told = std::abs((double_double(state.reactions[i]) - all[i].force).hi);
    b.error.take(q, (told + all[i].slack + all[i].per_rho * b.rho) * (1 + summation_slack));
    b.size.take(q, std::abs(state.reactions[i]));
  }
}

void error_prover::bound_element_values(const handed_out& state, error_bounds& b) const {
  if (state.element_values.empty()) return;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const quantity q = values_[i].moment ? quantity::moment : quantity::shear;
    const double told = std::abs((double_double(state.element_values[i]) - values_[i].value).hi);
    b.error.take(q, (told + noise_of(values_[i]) + values_[i].energy * b.rho) * (1 + summation_slack));
    b.size.take(q, std::abs(state.element_values[i]));
  }
}

bool error_prover::is_unloaded(const true_loads& l) const {
  const auto none = [](const double_double& x) { return x == 0.0; };
  return std::ranges::all_of(l.size, [](double x) { return x == 0.0; }) &&
         std::ranges::all_of(l.settlement, none) &&
         std::ranges::all_of(true_.pairs, [](const true_pair& p) { return p.face.hi * p.surface >= 0.0; });
}

/// All forces are 0 then, and where the supports hold the structure all displacements. Where they do not, it
/// may stand, unbent, wherever no pair is beyond its face.
void error_prover::bound_unloaded(const handed_out& state, error_bounds& b) {
  b.unloaded = true;
  b.unique = proves({});
  b.rho = 0.0;
  const auto take = [&b](quantity q, double value) { b.error.take(q, std::abs(value)); };
  for (std::size_t dof = 0; dof < true_.dofs() && b.unique; ++dof)
    take(true_.deflects[dof] != 0 ? quantity::w : quantity::slope, state.displacement[dof]);
  if (b.unique) bound_pairs(state, long_vector(true_.dofs()), b);
  if (!b.unique && state.element_values.empty()) {
    b.not_proved =
        "only contact holds the structure, and a structure given by its matrix has no moments to prove that "
        "it is not bent";
    return;
  }
  for (const double force : state.pair_forces) take(quantity::force, force);
  for (std::size_t i = 0; i < problem_.supports.size(); ++i)
    take(problem_.supports[i].dof == 0 ? quantity::reaction : quantity::moment, state.reactions[i]);
  if (state.element_values.empty()) return;
  const std::vector<element_value> kinds = true_.element_values(state.step, long_vector(true_.dofs()));
  for (std::size_t i = 0; i < kinds.size(); ++i)
    take(kinds[i].moment ? quantity::moment : quantity::shear, state.element_values[i]);
}

bool error_prover::is_refined(int step, std::span<const double> displacement) const {
  const auto same = [](const double_double& a, double b) { return a.hi == b; };
  return step == refined_step_ && std::ranges::equal(refined_, displacement, same);
}

long_vector error_prover::long_displacement(int step, std::span<const double> displacement,
                                            const true_loads& l) const {
  if (is_refined(step, displacement)) return refined_;
  long_vector u(true_.dofs());
  for (std::size_t dof = 0; dof < u.size(); ++dof)
    u[dof] = true_.fixed[dof] != 0 ? l.settlement[dof] : double_double(displacement[dof]);
  return u;
}

/// Nodal loads are sizes. Where there are none, what it takes to move one settling dof alone tells how large
/// the rounding of forces is that are none.
void error_prover::measure(const true_loads& l, error_bounds& b) const {
  const bool is_loaded = std::ranges::any_of(l.force, [](const double_double& f) { return f.hi != 0.0; });
  for (std::size_t dof = 0; dof < true_.dofs(); ++dof) {
    const quantity q = true_.deflects[dof] != 0 ? quantity::force : quantity::moment;
    b.size.take(q, std::abs(l.force[dof].hi));
    if (!is_loaded) b.settling.take(q, true_.root[dof] * true_.root[dof] * std::abs(l.settlement[dof].hi));
  }
}

void error_prover::keep(const handed_out& state, const long_vector& u, const error_bounds& b) {
  if (!keeps_proof_ || (b.unique && !stiffness_.proof())) return;  // a sparse factor is not kept
  const std::vector<double> displacement(state.displacement.begin(), state.displacement.end());
  proof_ = step_proof{displacement, state.pair_forces, state.reactions, state.element_values, u, b.closed,
                      z_,           stiffness_.proof()};
}

std::optional<error_bounds> error_prover::bound_closely(const handed_out& state) {
  if (!exactly_) return std::nullopt;
  closely_ = true;
  const error_bounds b = bound(state);
  closely_ = false;
  return b;
}

error_bounds error_prover::bound(const handed_out& state) {
  error_bounds b;
  const true_loads& l = loads_of(state.step);
  if (is_below_range(l)) {
    b.not_proved =
        "the problem has numbers, or cubes of lengths, below 1e-280: too near the smallest normal double, "
        "2e-308";
    return b;
  }
  if (is_unloaded(l)) {
    bound_unloaded(state, b);
    widen_by_extremes(problem_, state, b);
    const std::optional<double> largest_gap = b.size[quantity::gap];
    b.size = b.error;
    b.size[quantity::gap] = largest_gap;
    z_.clear();
    if (b.not_proved.empty()) keep(state, long_vector(true_.dofs()), b);
    return b;
  }
  const long_vector u = long_displacement(state.step, state.displacement, l);
  if (!is_refined(state.step, state.displacement)) {
    refined_step_ = 0;  // what was kept is of another state
    residual_ = residual_of(u, l);
    values_ = true_.element_values(state.step, u);
  }
  if (closely_) residual_ = residual_of(u, l);
  const residual& r = residual_;
  bool found = true;
  if (refined_bounds_ && refined_step_ != 0 && !closely_) {
    b = *refined_bounds_;
  } else {
    found = find_closed(u, r, b);
  }
  if (refined_step_ == 0 && has_exact_residual(l)) {  // that doubles do not factor K_A is known only now
    residual_ = residual_of(u, l);
    found = find_closed(u, r, b);
  }
  if (!found && !find_balanced(state.step, u, r, b)) return b;
  if (found && !is_semidefinite()) {
    b.not_proved = "it is not certain that the matrix is positive semidefinite";
    return b;
  }
  if (found) (void)proves(b.closed);  // that of K alone may have replaced its factor and its proof
  measure(l, b);
  if (b.unique) bound_displacements(state, u, b);
  bound_pairs(state, u, b);
  bound_forces(state, u, b);
  bound_reactions(state, r, u, b);
  bound_element_values(state, b);
  widen_by_extremes(problem_, state, b);
  if (b.unique) keep(state, u, b);  // of a balanced one the checker knows nothing
  return b;
}

}  // namespace contct::certify
