#include "contct/certify/error_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "contct/certify/extreme_bounds.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct::certify {
namespace {

/// Sums of doubles are off by less than this share of their magnitudes.
constexpr double of_sums = 0x1p-30;

/// What products of numbers that are all but 0 may lose.
constexpr double underflow = 1e-300;

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
    const double w = s.displacement[static_cast<std::size_t>(p.pairs[i].node) * dofs_per_node(p.geometry)];
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
  return true_.least_product < least || std::ranges::any_of(true_.k.values, too_small) ||
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

/// rho: the norm of the residual in K_A^-1, from above. z is about K_A^-1 r, e = r - K_A z, and
/// rho^2 = r'z + z'e + e' K_A^-1 e.
std::optional<double> error_prover::norm_of(const residual& r, double mu) {
  const std::size_t n = true_.dofs();
  long_vector z(n);
  std::vector<double> e(n);
  long_vector left = r.force;
  long_vector product;
  std::vector<double> sizes;  // of the products in row i
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t dof = 0; dof < n; ++dof) e[dof] = left[dof].hi;
    stiffness_.solve(e);
    for (std::size_t dof = 0; dof < n; ++dof) z[dof] += e[dof];
    if (pass == 1) sizes.assign(n, 0.0);
    product = stiffness_.times(z, sizes);
    for (std::size_t dof = 0; dof < n; ++dof)
      left[dof] = true_.fixed[dof] != 0 ? double_double(0.0) : r.force[dof] - product[dof];
  }
  double_double work;
  double slack = 0.0;
  double rest = 0.0;
  for (std::size_t dof = 0; dof < n; ++dof) {
    if (true_.fixed[dof] != 0) continue;
    work += z[dof] * (r.force[dof] + left[dof]);
    double size = sizes[dof];
    const double root = 1.0 / stiffness_.scale(dof);
    size += root * root * std::abs(z[dof].hi) * 2;  // the springs of A
    const double off = r.slack[dof] + 2 * true_rounding * size;
    slack += 2 * std::abs(z[dof].hi) * off;
    const double scaled = stiffness_.scale(dof) * (std::abs(left[dof].hi) + off);
    rest += scaled * scaled;
  }
  bool any = false;  // residual, or one that underflows
  for (std::size_t dof = 0; dof < n; ++dof)
    any = any || (true_.fixed[dof] == 0 && (r.force[dof].hi != 0.0 || r.slack[dof] > 0.0));
  const double square =
      (std::max(work.hi, 0.0) + slack + rest / mu + (any ? underflow : 0.0)) * (1 + of_sums);
  z_ = std::move(z);
  if (!std::isfinite(square)) return std::nullopt;
  return std::sqrt(square) * (1 + of_sums);
}

std::vector<int> error_prover::pressed(std::span<const double_double> u) const {
  std::vector<int> pairs;
  for (std::size_t i = 0; i < true_.pairs.size(); ++i)
    if (true_.fixed[true_.pairs[i].dof] == 0 && depth(i, u).hi > 0.0) pairs.push_back(static_cast<int>(i));
  return pairs;
}

rigid_rank error_prover::held_by(const std::vector<int>& closed) const {
  return structure_.held_by(
      [&](std::size_t i) { return std::ranges::binary_search(closed, static_cast<int>(i)); });
}

/// `closed`, and where these do not hold the structure, those nearest to their faces that do.
std::vector<int> error_prover::holding(std::span<const double_double> u, std::vector<int> closed) const {
  rigid_rank rank = held_by(closed);
  if (structure_.is_held(rank)) return closed;
  std::vector<int> nearest;
  for (int i = 0; i < static_cast<int>(true_.pairs.size()); ++i)
    if (true_.fixed[true_.pairs[i].dof] == 0 && !std::ranges::binary_search(closed, i)) nearest.push_back(i);
  std::ranges::stable_sort(nearest, {}, [&](int i) { return -depth(i, u).hi; });
  for (const int i : nearest) {
    const int before = rank.rank();
    rank.hold(structure_.held_by_pairs[i], structure_.dof_of_pair(i));
    if (rank.rank() > before) closed.push_back(i);
  }
  std::ranges::sort(closed);
  return closed;
}

/// Factor K_A; is it definite for certain?
bool error_prover::proves(const std::vector<int>& closed) {
  if (factored_ != closed) {
    factored_ = closed;
    mu_ = stiffness_.factor(closed) ? stiffness_.least_eigenvalue() : 0.0;
    inverse_root_mu_ = (1 + of_sums) / std::sqrt(mu_);
  }
  return mu_ > 0.0;
}

bool error_prover::is_semidefinite() {
  if (!std::holds_alternative<assembled>(problem_.geometry.kind)) return true;  // by its elements' formulas
  if (!semidefinite_)
    semidefinite_ = proves({}) || (exactly_semidefinite_ && exactly_semidefinite_() == true);
  return *semidefinite_;
}

bool error_prover::last_digits_decide() const {
  const auto* a = std::get_if<assembled>(&problem_.geometry.kind);
  if (a == nullptr || a->free_motions) return false;
  if (a->stiffness.last_digits.empty()) return false;
  std::vector<double> rows(true_.dofs());  // of S H S, where H has the half units
  for (std::size_t i = 0; i < a->stiffness.entries.size(); ++i) {
    const matrix_entry& e = a->stiffness.entries[i];
    if (true_.fixed[e.row] != 0 || true_.fixed[e.column] != 0) continue;
    const double scaled = a->stiffness.half_unit(i) * stiffness_.scale(e.row) * stiffness_.scale(e.column);
    rows[e.row] += scaled;
    if (e.row != e.column) rows[e.column] += scaled;
  }
  return !(std::ranges::max(rows) * (1 + of_sums) < mu_);
}

/// A: at first all pairs beyond their faces; those that are not so for certain leave it again.
bool error_prover::find_closed(std::span<const double_double> u, const residual& r, error_bounds& b) {
  b.closed = pressed(u);
  for (int tries = 0; tries < 3; ++tries) {
    if (!proves(b.closed)) {
      b.not_proved = "the stiffness is too ill-conditioned, or it is not certain that the structure is held";
      return false;
    }
    if (last_digits_decide()) {
      b.not_proved =
          "half a unit in the last digits that the matrix is written with decides whether it is held: "
          "`free_motions` says how many motions it leaves free";
      return false;
    }
    const std::optional<double> rho = norm_of(r, mu_);
    if (!rho) {
      b.not_proved = "the numbers are too large or too small";
      return false;
    }
    if (!erase_doubtful(u, *rho, b.closed)) {
      b.rho = *rho;
      return true;
    }
  }
  b.not_proved = "which pairs are in contact is not certain";
  return false;
}

bool error_prover::erase_doubtful(std::span<const double_double> u, double rho,
                                  std::vector<int>& closed) const {
  return std::erase_if(closed, [&](int i) {
           const true_pair& p = true_.pairs[i];
           const double moved = std::min(reach(p.dof), (1 + of_sums) / std::sqrt(p.stiffness.hi)) * rho;
           return !(depth(i, u).hi * (1 - of_sums) - doubt(i, u) > moved);
         }) > 0;
}

/// Where the pairs of A leave rigid motions free on which the load does no work at all: springs without force
/// hold the structure where it is, and change nothing else.
bool error_prover::find_balanced(int step, std::span<const double_double> u, const residual& r,
                                 error_bounds& b) {
  if (!structure_.truth) return false;
  b.closed = pressed(u);
  for (int tries = 0; tries < 3; ++tries) {
    if (!proves(holding(u, b.closed))) return false;
    const std::optional<double> rho = norm_of(r, mu_);
    if (!rho) return false;
    if (erase_doubtful(u, *rho, b.closed)) continue;
    b.rho = *rho;
    b.unique = false;
    if (!stands_free(step, u, b)) break;
    b.not_proved.clear();
    return true;
  }
  b.rho = std::numeric_limits<double>::infinity();
  b.unique = true;
  return false;
}

/// No work on what A leaves free, and no pair that this moves can be in contact.
bool error_prover::stands_free(int step, std::span<const double_double> u, const error_bounds& b) const {
  const rigid_rank held = held_by(b.closed);
  const rigid_work work = structure_.truth->work_of(problem_.steps[step - 1]);
  if (structure_.is_held(held) || structure_.truth->driven_by(work, held.dofs())) return false;
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    rigid_rank with_it = held;
    with_it.hold(structure_.held_by_pairs[i], structure_.dof_of_pair(i));
    if (with_it.rank() > held.rank() && !is_certainly_open(i, u, b.rho)) return false;
  }
  return true;
}

void error_prover::bound_displacements(const handed_out& state, std::span<const double_double> u,
                                       error_bounds& b) const {
  for (std::size_t dof = 0; dof < true_.dofs(); ++dof) {
    const quantity q = true_.deflects[dof] != 0 ? quantity::w : quantity::slope;
    const double told = std::abs((double_double(state.displacement[dof]) - u[dof]).hi);
    const double moved = true_.fixed[dof] != 0 ? true_rounding * std::abs(u[dof].hi) : reach(dof) * b.rho;
    b.error.take(q, (told + moved) * (1 + of_sums));
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
    const double root = std::sqrt(p.stiffness.hi) * (1 + of_sums);
    const bool held = true_.fixed[p.dof] != 0;
    const bool open = is_certainly_open(i, u, b.rho);
    const double moved = held || open ? 0.0 : std::min(root, p.stiffness.hi * reach(p.dof)) * b.rho;
    const double noise = open ? 0.0 : p.stiffness.hi * doubt(i, u);
    b.error.take(quantity::force, (told + noise + moved) * (1 + of_sums));
    b.size.take(quantity::force, std::abs(state.pair_forces[i]));
  }
}

/// How far the depth of a pair in any state within rho of u can be from that under u.
double error_prover::reach_of_pair(std::size_t pair, std::span<const double_double> u, double rho) const {
  const int dof = true_.pairs[pair].dof;
  const double moved = true_.fixed[dof] != 0 || rho == 0.0 ? 0.0 : reach(dof) * rho * (1 + of_sums);
  return moved + doubt(pair, u);
}

/// Each pair's status, and its gap, which is 0 for a pair in contact; the bounds on gaps only where
/// displacements have bounds.
void error_prover::bound_pairs(const handed_out& state, std::span<const double_double> u,
                               error_bounds& b) const {
  for (std::size_t i = 0; i < true_.pairs.size(); ++i) {
    const contact_pair& p = problem_.pairs[i];
    const bool is_closed = state.isep[i] == in_contact;
    const double told =
        gap_of(p, state.displacement[static_cast<std::size_t>(true_.pairs[i].dof)], is_closed);
    const double_double gap = -depth(i, u);
    const double reach = reach_of_pair(i, u, b.rho);
    const bool is_wrong = is_closed ? gap.hi * (1 - of_sums) > reach : -gap.hi * (1 - of_sums) > reach;
    if (is_wrong && !b.wrong_status) b.wrong_status = i;
    if (!b.unique) continue;
    // A pair that presses has no gap, whatever its depth.
    const double least = std::abs((double_double(told) - std::max(gap.hi - reach, 0.0)).hi);
    const double most = std::abs((double_double(told) - std::max(gap.hi + reach, 0.0)).hi);
    b.error.take(quantity::gap, gap.hi > reach
                                    ? std::abs((double_double(told) - gap).hi) * (1 + of_sums) + reach
                                    : std::max(least, most) * (1 + of_sums));
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
    const std::size_t dof = static_cast<std::size_t>(s.node) * per_node + s.dof;
    true_reaction& force = all.emplace_back();
    if (!s.fixed) {
      force.force = -(long_decimal(s.spring) * u[dof]);
      force.slack = true_rounding * std::abs(force.force.hi);
      if (true_.fixed[dof] == 0)
        force.per_rho = std::min(std::sqrt(s.spring) * (1 + of_sums), s.spring * reach(dof));
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
    b.error.take(q, (told + all[i].slack + all[i].per_rho * b.rho) * (1 + of_sums));
    b.size.take(q, std::abs(state.reactions[i]));
  }
}

void error_prover::bound_element_values(const handed_out& state, error_bounds& b) const {
  if (state.element_values.empty()) return;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const quantity q = values_[i].moment ? quantity::moment : quantity::shear;
    const double told = std::abs((double_double(state.element_values[i]) - values_[i].value).hi);
    b.error.take(q, (told + noise_of(values_[i]) + values_[i].energy * b.rho) * (1 + of_sums));
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
