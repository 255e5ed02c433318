#include "contct/proof/error_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contct/path/solve_problem.hpp"

namespace contct {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Sets displacements to 0 if they are so small that their products underflow.
void flush_tiny(long_vector& u) {
  constexpr double none = 1e-140;
  for (double_double& x : u)
    if (std::abs(x.hi) < none) x = 0.0;
}

quantity kind_of(const element_value& v) {
  return v.moment ? quantity::moment : quantity::shear;
}

quantity kind_of(const support& s) {
  return s.dof == 0 ? quantity::reaction : quantity::moment;
}

/// Takes the error bound, which is returned, and the size of the reported number `told`. x: the same number
/// computed from the state, with an error of at most `slack`; x changes by at most `moved` from the state to
/// the equilibrium.
double take(error_bounds& b, quantity q, double told, const double_double& x, double slack, double moved) {
  const double off = std::abs((double_double(told) - x).hi);
  const double error = (off + slack + moved) * (1 + summation_slack);
  b.error.take(q, error);
  b.size.take(q, std::abs(told));
  return error;
}

}  // namespace

structure_state with_numbers(const problem& p, structure_state s) {
  s.numbers = statics_of(p, p.steps[s.step - 1], s.displacement, s.isep, std::move(s.numbers));
  return s;
}

error_prover::error_prover(const problem& p, const linear_structure& s, exact_means* exactly,
                           bool keeps_proofs)
    : problem_(p),
      structure_(s),
      system_(long_system_of(p)),
      contacts_(p, s, system_, keeps_proofs),
      exactly_(exactly),
      keeps_proofs_(keeps_proofs) {}

bool error_prover::has_exact_residual(const long_loads& l) {
  return exactly_ != nullptr && l.step > 0 && (closely_ || contacts_.stiffness().has_32_digits());
}

long_residual error_prover::residual_of(std::span<const double_double> u, const long_loads& l) {
  if (has_exact_residual(l))
    if (std::optional<long_vector> exactly = exactly_->residual_of(l.step, u))
      return system_.residual_of_rounded(std::move(*exactly));
  return system_.residual(u, l);
}

bool error_prover::is_refined(int step, std::span<const double> displacement) const {
  const auto same = [](const double_double& a, double b) { return a.hi == b; };
  return state_.refined && step == state_.step && std::ranges::equal(state_.u, displacement, same);
}

long_vector error_prover::long_displacement(int step, std::span<const double> displacement,
                                            const long_loads& l) const {
  if (is_refined(step, displacement)) return state_.u;
  long_vector u(displacement.begin(), displacement.end());
  for (std::size_t dof = 0; dof < u.size(); ++dof)
    if (system_.fixed[dof] != 0) u[dof] = l.settlement[dof];
  return u;
}

/// Sets `correction` to K_A^-1 r, with r = `force`; returns r' K_A^-1 r, the square of the norm of r.
double error_prover::solve(const long_vector& force, std::vector<double>& correction) {
  double square = 0.0;
  for (std::size_t dof = 0; dof < force.size(); ++dof) correction[dof] = force[dof].hi;
  contacts_.stiffness().solve(correction);
  for (std::size_t dof = 0; dof < force.size(); ++dof) square += force[dof].hi * correction[dof];
  return square;
}

/// Corrects the displacements in state_, and stores their residual there. Repeats u += K_A^-1 r until r is
/// negligible relative to the loads, or no longer decreases. Then the pairs beyond their faces become the new
/// A, and all is repeated until A no longer changes. A is changed only then, because the depth of a stiff
/// pair may be less than the rounding of a correction of u. False if the first K_A is not certainly positive
/// definite.
bool error_prover::correct(const long_loads& l) {
  constexpr int most = 40;
  constexpr double none = 0x1p-150;  // relative to the loads' work; then u is right to 2^-75
  long_vector u = std::move(state_.u);
  flush_tiny(u);
  std::vector<int> closed = contacts_.pressed(u);
  long_vector best;
  double least = std::numeric_limits<double>::infinity();
  double before = least;  // `square` of the previous correction with the same A
  std::vector<double> correction(u.size());
  for (int i = 0; i < most && contacts_.proves(contacts_.holding(u, closed)); ++i) {
    const long_residual r = residual_of(u, l);
    const std::vector<int> now = contacts_.pressed(u);
    double square = solve(r.force, correction);
    double work = 0.0;
    for (std::size_t dof = 0; dof < u.size(); ++dof) work += l.force[dof].hi * u[dof].hi;
    // Each A has another norm of the residual, so only norms of the same A are compared.
    if (best.empty() || (now == closed && (square < least || square == 0.0))) {
      best = u;
      state_.left = r;
      if (now == closed) least = square;
    }
    if (now != closed) square = solve(system_.linear_residual(r, u, closed), correction);
    const bool nothing = (square >= 0.0 && square <= none * work) ||
                         std::ranges::all_of(correction, [](double x) { return x == 0.0; });
    if (nothing || !(square < before)) {
      if (now == closed) break;
      closed = now;
      before = std::numeric_limits<double>::infinity();
      continue;
    }
    before = square;
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      if (system_.fixed[dof] == 0) u[dof] += correction[dof];
    flush_tiny(u);
  }
  state_.u = std::move(best);
  return !state_.u.empty();
}

/// Sets the status of each pair that is on one side of its face in all states within rho of u. If rho is not
/// proved: of each pair whose force exceeds rounding.
void error_prover::settle_statuses(const long_loads& l, std::span<int> isep) const {
  double largest = 0.0;
  for (const double_double& f : l.force) largest = std::max(largest, std::abs(f.hi));
  const auto force_at = [&](std::size_t i) {
    return system_.pairs[i].stiffness.hi * system_.depth(i, state_.u).hi;
  };
  for (std::size_t i = 0; i < isep.size(); ++i) largest = std::max(largest, force_at(i));
  for (std::size_t i = 0; i < isep.size(); ++i) {
    const double deep = system_.depth(i, state_.u).hi;
    const bool is_settled = state_.contacts
                                ? std::abs(deep) > contacts_.reach_of_pair(i, state_.u, state_.contacts->rho)
                                : std::abs(force_at(i)) > 1e-12 * largest;
    if (is_settled) isep[i] = deep > 0.0 ? in_contact : separated;
  }
}

/// The numbers of the state in state_. Reactions and element forces within the rounding of 32 digits are 0.
end_numbers error_prover::numbers_of(std::span<const int> isep) const {
  const auto told = [](const double_double& x, double noise) { return std::abs(x.hi) > noise ? x.hi : 0.0; };
  end_numbers n;
  for (std::size_t i = 0; i < isep.size(); ++i) {
    const double_double deep = system_.depth(i, state_.u);
    const bool presses = isep[i] == in_contact && deep.hi > 0.0;
    n.pair_forces.push_back(presses ? (system_.pairs[i].stiffness * deep).hi : 0.0);
  }
  for (const support_force& f : support_forces()) n.reactions.push_back(told(f.force, f.slack));
  for (const element_value& v : state_.values) n.element_values.push_back(told(v.value, v.noise()));
  return n;
}

bool error_prover::refine(structure_state& s) {
  const long_loads& l = system_.at_end_of(s.step);
  s.numbers = {};
  state_ = {s.step, false, long_displacement(s.step, s.displacement, l), {}, {}, {}};
  (void)is_semidefinite();  // before K_A is factored, because it may replace this factor
  if (system_.is_at_rest(l) && contacts_.proves({})) {
    std::fill(state_.u.begin(), state_.u.end(), 0.0);
    state_.left = residual_of(state_.u, l);
  } else if (!correct(l)) {
    return false;
  }
  state_.refined = true;
  state_.values = system_.element_values(s.step, state_.u);
  std::ranges::transform(state_.u, s.displacement.begin(), &double_double::hi);
  contact_set found;
  if (contacts_.find(state_.u, state_.left, found)) state_.contacts = std::move(found);
  settle_statuses(l, s.isep);
  s.numbers = numbers_of(s.isep);
  return true;
}

/// Is K without pairs proved to be semidefinite, so that the energy is convex? May replace the factor.
bool error_prover::is_semidefinite() {
  if (!std::holds_alternative<assembled>(problem_.geometry.kind)) return true;  // beams, plates: always
  if (!semidefinite_)
    semidefinite_ = contacts_.proves({}) || (exactly_ != nullptr && exactly_->is_semidefinite());
  return *semidefinite_;
}

/// Sets the sizes of nodal loads and, if no load acts, those of settlements. Measures the residual of the
/// state and the largest reported deflection.
void error_prover::measure(const structure_state& told, const long_loads& l, error_bounds& b) const {
  const bool is_loaded = std::ranges::any_of(l.force, [](const double_double& f) { return f.hi != 0.0; });
  double unbalanced = 0.0;
  double largest = 0.0;
  for (std::size_t dof = 0; dof < system_.dofs(); ++dof) {
    const bool deflects = system_.deflects[dof] != 0;
    const double root = system_.root[dof];
    const quantity q = deflects ? quantity::force : quantity::moment;
    b.size.take(q, std::abs(l.force[dof].hi));
    if (!is_loaded) b.settling.take(q, root * root * std::abs(l.settlement[dof].hi));
    if (deflects) b.largest_deflection = std::max(b.largest_deflection, std::abs(told.displacement[dof]));
    if (!(root > 0.0)) continue;
    unbalanced = std::max(unbalanced, std::abs(state_.left.force[dof].hi) / root);
    largest = std::max(largest, root * std::abs(state_.u[dof].hi));
  }
  b.equilibrium = unbalanced > 0.0 ? unbalanced / largest : 0.0;
}

void error_prover::bound_displacements(const structure_state& told, error_bounds& b) const {
  for (std::size_t dof = 0; dof < system_.dofs(); ++dof) {
    const double_double& u = state_.u[dof];
    const double moved =
        system_.fixed[dof] != 0 ? long_rounding * std::abs(u.hi) : contacts_.reach(dof) * b.rho;
    take(b, system_.deflects[dof] != 0 ? quantity::w : quantity::slope, told.displacement[dof], u, 0.0,
         moved);
  }
}

void error_prover::bound_forces(const structure_state& told, error_bounds& b) const {
  std::vector<double> errors;
  for (std::size_t i = 0; i < system_.pairs.size(); ++i) {
    const long_pair& p = system_.pairs[i];
    const double_double deep = system_.depth(i, state_.u);
    const double_double force = deep.hi <= 0.0 ? double_double(0.0) : p.stiffness * deep;
    const double root = b.convex ? std::sqrt(p.stiffness.hi) * (1 + summation_slack) : unbounded;
    const bool held = system_.fixed[p.dof] != 0;
    const bool open = contacts_.is_certainly_open(i, state_.u, b.rho);
    const double moved = held || open ? 0.0 : std::min(root, p.stiffness.hi * contacts_.reach(p)) * b.rho;
    const double noise = open ? 0.0 : p.stiffness.hi * system_.doubt(i, state_.u);
    errors.push_back(take(b, quantity::force, told.numbers.pair_forces[i], force, noise, moved));
  }
  const std::vector<pair_in<double>> at_supports = held_under(problem_, problem_.steps[told.step - 1]);
  auto held = at_supports.begin();
  for (const bed& on : problem_.beds) {
    double worst = 0.0;
    for (std::size_t i = 0; i < on.share.size(); ++i) {
      const std::size_t pair = on.first_pair + i;
      const double rounding = 0x1p-51 * std::abs(told.numbers.pair_forces[pair]);  // of share and quotient
      worst = std::max(worst, (errors[pair] + rounding) / on.share[i]);
    }
    for (std::size_t i = 0; i < on.held.size(); ++i, ++held) {  // its displacement is prescribed
      const double unmoved = on.held[i].face;
      const double sizes =
          std::abs(told.displacement[held->dof]) + std::abs(unmoved) + std::abs(held->face - unmoved);
      worst = std::max(worst, 0x1p-48 * held->stiffness * sizes / on.held_share[i]);
    }
    b.pressure = b.pressure.value_or(0.0) + worst * (1 + summation_slack);  // a node may be on several beds
  }
}

/// Measures how far reported pairs are on the wrong side of their faces. If displacements have bounds or a
/// load acts, finds the first pair with a certainly wrong status. Bounds the errors of gaps if displacements
/// have bounds; the reported gap of a pair in contact is 0.
void error_prover::bound_pairs(const structure_state& told, error_bounds& b) const {
  const std::vector<pair_in<double>> pairs = pairs_under(problem_, problem_.steps[told.step - 1]);
  for (std::size_t i = 0; i < system_.pairs.size(); ++i) {
    const bool is_closed = told.closed(i);
    const double seen = pairs[i].seen_in(told.displacement);
    const double beyond = depth_of(pairs[i], seen);
    double& wrong_side = is_closed ? b.off_face : b.beyond_face;
    wrong_side = std::max(wrong_side, is_closed ? -beyond : beyond);
    if (!b.unique && b.at_rest) continue;
    const double told_gap = gap_of(pairs[i], seen, is_closed);
    const double_double gap = -system_.depth(i, state_.u);
    const double reach = contacts_.reach_of_pair(i, state_.u, b.rho);
    const bool is_wrong =
        is_closed ? gap.hi * (1 - summation_slack) > reach : -gap.hi * (1 - summation_slack) > reach;
    if (is_wrong && !b.wrong_status) b.wrong_status = i;
    if (!b.unique) continue;
    const auto off = [&](const double_double& x) {
      return std::abs((double_double(told_gap) - x).hi) * (1 + summation_slack);
    };
    b.error.take(quantity::gap, gap.hi > reach ? off(gap) + reach
                                               : std::max(off(std::max(gap.hi - reach, 0.0)),
                                                          off(std::max(gap.hi + reach, 0.0))));
    b.size.take(quantity::gap, std::abs(told_gap));
  }
}

/// The forces of all supports, in the order of the file.
std::vector<error_prover::support_force> error_prover::support_forces(bool convex) const {
  std::vector<support_force> all;
  for (const auto& s : system_.supports) {
    support_force& force = all.emplace_back();
    force.force = s.force(state_.u, [&](int dof) { return state_.left.needed[dof]; });
    if (!s.fixed) {
      force.slack = long_rounding * std::abs(force.force.hi);
      const double root = convex ? std::sqrt(s.spring.hi) * (1 + summation_slack) : unbounded;
      if (system_.fixed[s.dof] == 0) force.per_rho = std::min(root, s.spring.hi * contacts_.reach(s.dof));
    } else if (s.reacts) {
      // Of a matrix, only the part at free dofs is proved semidefinite.
      const bool all_semidefinite = static_cast<bool>(structure_.truth);
      force.slack = state_.left.slack[s.dof];
      if (all_semidefinite) force.per_rho = system_.root[s.dof];
      for (const auto& [column, entry] : system_.stiffness[s.dof])
        if (!all_semidefinite && system_.fixed[column] == 0)
          force.per_rho += std::abs(entry.hi) * contacts_.reach(column) * (1 + summation_slack);
    }
  }
  return all;
}

/// Prepares the bounds for a state without loads at nodes: all contact forces are 0, and so are all
/// displacements of nodes if the supports hold the structure. Otherwise the structure may be at any place,
/// unbent, with no pair beyond its face. Returns false and sets `b.not_proved` if bending cannot be excluded.
bool error_prover::rests(const structure_state& told, const long_loads& l, error_bounds& b) {
  const long_vector at_rest(system_.dofs());
  state_ = {};  // frees the memory of the refined state first
  state_ = {
      told.step, false, at_rest, system_.residual(at_rest, l), system_.element_values(told.step, at_rest),
      {}};
  const auto* const on = std::get_if<beam>(&problem_.geometry.kind);
  b.unloaded = on == nullptr || !acts_inside(*on, problem_.steps[told.step - 1]);
  b.unique = contacts_.proves({});
  b.rho = 0.0;
  if (b.unique || !told.numbers.element_values.empty()) return true;
  b.not_proved =
      "only contact holds the structure; the proof that it is not bent needs moments, which a structure "
      "given by its matrix does not have";
  return false;
}

void error_prover::keep(const structure_state& told, error_bounds& b) const {
  const std::optional<stiffness_proof>& of_stiffness = contacts_.stiffness().proof();
  if (!keeps_proofs_ || (b.unique && !of_stiffness)) return;  // a sparse factor is not kept
  b.proof = std::make_shared<step_proof>(
      step_proof{told, state_.u, b.closed, b.at_rest ? long_vector() : contacts_.z(), of_stiffness});
}

/// Sets A and rho of the state in `b`; returns false and sets `b.not_proved` if A and rho cannot be proved.
bool error_prover::find_contacts(const structure_state& told, const long_loads& l, contact_set& b) {
  const bool semidefinite = is_semidefinite();  // before K_A is factored, because it may replace this factor
  bool found = true;
  if (!is_refined(told.step, told.displacement)) {
    state_ = {told.step, false, long_displacement(told.step, told.displacement, l), {}, {}, {}};
    state_.values = system_.element_values(told.step, state_.u);
  }
  if (!state_.refined || closely_) state_.left = residual_of(state_.u, l);
  if (state_.contacts && !closely_) {
    b = *state_.contacts;
  } else {
    found = contacts_.find(state_.u, state_.left, b);
  }
  if (!state_.refined && has_exact_residual(l)) {  // find() has shown that doubles do not factor K_A
    state_.left = residual_of(state_.u, l);
    found = contacts_.find(state_.u, state_.left, b);
  }
  if (!found) return contacts_.find_balanced(l.step, state_.u, state_.left, b);
  b.convex = semidefinite;
  // If free_motions is given, rounded entries may make K indefinite; K_A is definite.
  if (!semidefinite && std::get<assembled>(problem_.geometry.kind).free_motions.value_or(0) == 0) {
    b.not_proved = "it is not certain that the matrix is positive semidefinite" +
                   (structure_.rigid_motions > 0 ? ": " + nearly_free_words(structure_) : std::string());
    return false;
  }
  (void)contacts_.proves(b.closed);  // the bounds need the factor of K_A
  return true;
}

error_bounds error_prover::bound(const structure_state& told) {
  error_bounds b;
  const long_loads& l = system_.at_end_of(told.step);
  if (system_.is_below_range(l)) {
    b.not_proved =
        "the problem has numbers, or cubes of lengths, below 1e-280, too near the smallest normal double, "
        "2e-308";
    return b;
  }
  b.at_rest = system_.is_at_rest(l);
  if (!(b.at_rest ? rests(told, l, b) : find_contacts(told, l, b))) return b;
  measure(told, l, b);
  if (b.unique) bound_displacements(told, b);
  bound_pairs(told, b);
  bound_forces(told, b);
  const std::vector<support_force> forces = support_forces(b.convex);
  for (std::size_t i = 0; i < forces.size(); ++i)
    take(b, kind_of(problem_.supports[i]), told.numbers.reactions[i], forces[i].force, forces[i].slack,
         b.rho == 0.0 ? 0.0 : forces[i].per_rho * b.rho);
  for (std::size_t i = 0; i < told.numbers.element_values.size(); ++i) {
    const element_value& v = state_.values[i];
    take(b, kind_of(v), told.numbers.element_values[i], v.value, v.noise(), v.energy * b.rho);
  }
  widen_by_extremes(problem_, told, b);
  if (b.unique || b.at_rest) keep(told, b);  // check_proof.py cannot check a balanced state under loads
  return b;
}

error_bounds error_prover::bound_closely(const structure_state& told) {
  closely_ = true;
  error_bounds b = bound(told);
  closely_ = false;
  return b;
}

}  // namespace contct
