#include "contct/certify/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "contct/matrix/cholesky.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/text/memory.hpp"

namespace contct::certify {
namespace {

using outcome = reference_answer::outcome;

double share(double part, double whole) {
  return part > 0.0 ? part / whole : 0.0;
}

/// The worst of what is above the tolerance, in words.
std::string worst_of(const certificate& c) {
  const std::pair<double, const char*> parts[] = {
      {c.displacement_error, "the deflections are off"},
      {c.shape_error, "the displacements are off"},
      {c.penetration, "a separated pair is beyond its face"},
      {c.tension, "a pair in contact pulls: it is off its face"},
      {c.equilibrium, "loads and forces do not balance: they differ"},
  };
  for (const auto& [amount, words] : parts) {
    if (amount <= c.tolerance) continue;
    char text[120];
    (void)std::snprintf(text, sizeof text, "%s by %.2g", words, amount);
    return text;
  }
  return "";
}

/// A sparse factor that fits into memory three times, and whose product takes a minute or less.
bool can_be_proved_by_columns(const linear_structure& s) {
  if (!matrix::sparse_factor::available()) return false;
  constexpr double most_flops = 5e10;
  const auto factor = matrix::sparse_factor::make(s.stiffness.columns());
  return 3 * factor->bytes() <= text::memory_limit() && factor->flops() <= most_flops;
}

/// A band, of which two more are held during a proof, besides those of the path and of the comparison.
bool can_be_proved(const linear_structure& s) {
  if (!s.stiffness.is_band()) return can_be_proved_by_columns(s);
  const std::int64_t width = s.stiffness.band().subdiagonals() + 1;
  constexpr std::int64_t bytes = 40;  // of five doubles
  return bytes * s.dofs() * width <= text::memory_limit();
}

/// The pressed pairs, and where these and the supports leave a motion free, open ones that would stop it: at
/// rest, their springs take no force.
std::vector<char> holding(const linear_structure& s, std::vector<char> pressed) {
  rigid_rank rank = s.held_by([&](std::size_t i) { return pressed[i] != 0; });
  for (const int pair : s.pairs_that_hold(rank)) pressed[pair] = 1;
  return pressed;
}

}  // namespace

int digits_of(const certificate& c) {
  constexpr int most = 15;
  if (!c.proved || !(c.worst_share < 1.0)) return 0;
  return c.worst_share > 0.0 ? std::min(most, static_cast<int>(-std::log10(c.worst_share))) : most;
}

certifier::certifier(const linear_structure& s, load_history total_load)
    : structure_(s), total_load_(std::move(total_load)) {
  for (int dof = 0; dof < s.dofs(); ++dof) {
    scale_.push_back(std::sqrt(s.stiffness.diagonal(s.row_of(dof))));
    const std::size_t at = dof;
    if (deflects(at) && s.fixed[at] == 0) largest_scale_ = std::max(largest_scale_, scale_[at]);
  }
}

certifier::certifier(const problem& p, const linear_structure& s, exact_residual exactly,
                     semidefinite_test exactly_semidefinite)
    : certifier(s, loads_of(p, s)) {
  problem_ = &p;  // NOLINT(cppcoreguidelines-prefer-member-initializer): a delegating constructor has none
  if (can_be_proved(s))
    prover_ = std::make_unique<error_prover>(p, s, std::move(exactly), std::move(exactly_semidefinite));
}

state_refiner certifier::refiner() {
  if (!prover_) return nullptr;
  return [this](int step, std::span<double> displacement, std::span<int> isep) {
    return prover_->refine(step, displacement, isep);
  };
}

void certifier::step_ended(const step_state& s) {
  steps_.push_back(s.fraction == 1.0 ? std::optional(judge(s)) : std::nullopt);
  proofs_.push_back(prover_ && s.fraction == 1.0 ? prover_->take_proof() : std::nullopt);
  if (proofs_.back()) proofs_.back()->statuses.assign(s.isep.begin(), s.isep.end());
}

void certifier::keep_proofs() {
  if (prover_) prover_->keep_proof();
}

bool certifier::all_exact() const {
  return std::all_of(steps_.begin(), steps_.end(), [](const auto& c) { return c && c->exact; });
}

certificate certifier::judge(const step_state& s) {
  certificate c;
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(s.displacement.begin(), s.displacement.end(), finite)) {
    c.problem = "a displacement is not a finite number";  // it would slip through every comparison below
    return c;
  }
  std::vector<double> load(s.displacement.size(), 0.0);
  total_load_(s.step, load);
  c.rcond = s.rcond;
  c.independent = !s.from_reference;
  remember_sizes(s.displacement);
  if (prover_) {
    prove(s, c);
  } else if (problem_ != nullptr) {
    c.proof_tried = true;
    c.tolerance = certified_share;
    c.problem =
        "no error bound is proved: its factors take too much memory or time, or CHOLMOD is not built in";
  }
  if (c.exact) measure_state(s, load, c);
  const bool beyond_face = !c.unique && c.penetration > certified_share;  // no bound knows where it may stand
  if (!c.exact || beyond_face) compare(s, load, c);
  if (!c.exact) find_pulling_pair(s, c);
  return c;
}

/// Which pair in contact pulls most, where that is more than a millionth of the largest contact force.
void certifier::find_pulling_pair(const step_state& s, certificate& c) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < structure_.pairs.size(); ++i) {
    const std::size_t dof = structure_.dof_of_pair(static_cast<int>(i));
    const double force = force_of(structure_.pairs[i], s.displacement[dof], s.isep[i] == in_contact);
    largest = std::max(largest, std::abs(force));
    if (-force > c.pull) {
      c.pulling = static_cast<int>(i);
      c.pull = -force;
    }
  }
  if (c.pull <= certified_share * largest) c.pulling = -1;
}

void certifier::prove(const step_state& s, certificate& c) {
  const handed_out handed = handed_out_at(*problem_, s);
  take(prover_->bound(handed), s, c);
  if (!c.proved || c.exact) return;
  if (const std::optional<error_bounds> closer = prover_->bound_closely(handed)) take(*closer, s, c);
}

std::string certifier::status_words(std::size_t pair, const step_state& s) const {
  const contact_pair& p = structure_.pairs[pair];
  const double off = p.surface * (p.face - s.displacement[structure_.dof_of_pair(pair)]);
  char text[120];
  (void)std::snprintf(text, sizeof text, "pair %zu is given as %s, but it is %s its face by %.2g", pair + 1,
                      s.isep[pair] == in_contact ? "in contact" : "separated",
                      s.isep[pair] == in_contact ? "off" : "beyond", std::abs(off));
  return text;
}

void certifier::take(const error_bounds& b, const step_state& s, certificate& c) {
  c.proof_tried = true;
  c.unique = b.unique;
  c.tolerance = certified_share;
  if (!b.not_proved.empty()) {
    c.problem = "no error bound is proved: " + b.not_proved;
    return;
  }
  c.proved = true;
  c.error = b.error;
  c.allowed = allowed_.of(b, prover_->span());
  c.worst_share = worst_share(c.error, c.allowed);
  c.problem = worst_bound(c.error, c.allowed);
  if (c.problem.empty() && b.wrong_status) c.problem = status_words(*b.wrong_status, s);
  c.exact = c.problem.empty();
  c.displacement_error = share_of(c.error[quantity::w], c.allowed[quantity::w]);
  c.shape_error = c.worst_share;
}

/// With the reference solution: the verdict where no proof was tried, and what is wrong where one failed.
void certifier::compare(const step_state& s, std::span<const double> load, certificate& c) {
  if (!reference_) reference_.emplace(structure_);
  const reference_answer answer = reference_->solve(load, total_load_.work(s.step));
  remember_sizes(answer.displacement);
  if (!c.proof_tried)
    c.tolerance = std::min(certificate_factor * std::numeric_limits<double>::epsilon() / s.rcond,
                           certificate_never_above);
  c.displacement_error = c.shape_error = 0.0;
  c.unique = answer.unique;
  measure_state(s, load, c);
  c.unfounded = answer.how == outcome::no_equilibrium;
  const std::string of_proof = std::exchange(c.problem, "");
  if (c.unfounded) {
    c.problem =
        "there is no equilibrium: no support and no face stops a rigid-body motion on which the load does "
        "work";
  } else if (answer.how == outcome::none_seen) {
    c.problem =
        "there is no reference solution: as far as double precision shows, the load drives a rigid-body "
        "motion "
        "that nothing stops; whether there is an equilibrium is not decided";
  } else if (answer.how == outcome::not_found) {
    c.problem = "there is no reference solution: the stiffness is too ill-conditioned";
  } else {
    if (c.unique) compare_with(answer, s, c);
    c.problem = worst_of(c);
  }
  // What is proved, but not closely enough, is nearer to the truth than a reference solution beyond that
  // bound.
  const bool reference_is_off = answer.how != outcome::found ||
                                c.displacement_error * largest_length() >
                                    c.error[quantity::w].value_or(std::numeric_limits<double>::infinity());
  const bool of_bounds = c.proved && !of_proof.empty();
  if (c.problem.empty() || (of_bounds && !c.unfounded && reference_is_off)) c.problem = of_proof;
  c.exact = c.problem.empty();
}

void certifier::remember_sizes(std::span<const double> displacement) {
  for (std::size_t dof = 0; dof < displacement.size(); ++dof) {
    const double size = std::abs(displacement[dof]);
    largest_displacement_ = std::max(largest_displacement_, scale_[dof] * size);
    if (deflects(dof)) largest_deflection_ = std::max(largest_deflection_, size);
  }
}

double certifier::largest_length() const {
  if (largest_scale_ == 0.0) return largest_deflection_;
  return std::max(largest_deflection_, largest_displacement_ / largest_scale_);
}

/// From the state alone: equilibrium, penetration, tension.
void certifier::measure_state(const step_state& s, std::span<const double> load, certificate& c) const {
  const auto row = [this](std::size_t dof) { return structure_.row_of(static_cast<int>(dof)); };
  std::vector<double> u(load.size());
  std::vector<long double> left(load.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    u[row(dof)] = s.displacement[dof];
    left[row(dof)] = structure_.in_row(dof, load[dof]);
  }
  structure_.stiffness.subtract_product(std::span<const double>(u), left);
  std::vector<double> stiffness(load.size());  // on the diagonal, springs included
  for (std::size_t dof = 0; dof < load.size(); ++dof) stiffness[dof] = scale_[dof] * scale_[dof];
  double deepest = 0.0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < structure_.pairs.size(); ++i) {
    const contact_pair& p = structure_.pairs[i];
    const std::size_t dof = structure_.dof_of_pair(static_cast<int>(i));
    const double pressing = p.surface * (s.displacement[dof] - p.face);
    if (s.isep[i] == separated) {
      deepest = std::max(deepest, pressing);
    } else {
      farthest = std::max(farthest, -pressing);
      if (structure_.fixed[dof] != 0) continue;  // the support takes its force
      left[row(dof)] -=
          static_cast<long double>(p.stiffness) * (static_cast<long double>(s.displacement[dof]) - p.face);
      stiffness[dof] += p.stiffness;
    }
  }
  double unbalanced = 0.0;
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    unbalanced =
        std::max(unbalanced, std::abs(static_cast<double>(left[row(dof)])) / std::sqrt(stiffness[dof]));
  }
  c.penetration = share(deepest, largest_length());
  c.tension = share(farthest, largest_length());
  c.equilibrium = share(unbalanced, largest_displacement_);
}

void certifier::compare_with(const reference_answer& a, const step_state& s, certificate& c) const {
  double deflection = 0.0;
  double any = 0.0;
  for (std::size_t dof = 0; dof < s.displacement.size(); ++dof) {
    const double off = std::abs(s.displacement[dof] - a.displacement[dof]);
    any = std::max(any, scale_[dof] * off);
    if (deflects(dof)) deflection = std::max(deflection, off);
  }
  c.displacement_error = share(deflection, largest_length());
  c.shape_error = share(any, largest_displacement_);
}

namespace {

/// The reference solution, and where that gives up, what the proofs' own residuals lead to from there.
reference_answer solve_for(reference_solver& finds, std::span<const double> load, const rigid_work& work,
                           int step, double share, certifier* helper) {
  reference_answer answer = finds.solve(load, work);
  if (answer.how != outcome::not_found || helper == nullptr) return answer;
  std::vector<int> isep;
  for (const char pressed : answer.pressed) isep.push_back(pressed != 0 ? in_contact : separated);
  if (!helper->search(step, share, answer.displacement, isep)) return answer;
  for (std::size_t i = 0; i < isep.size(); ++i) answer.pressed[i] = isep[i] == in_contact ? 1 : 0;
  answer.how = outcome::found;
  return answer;
}

fallback_solver fallback(const linear_structure& s, load_history total_load, certifier* helper) {
  return [&s, loads = std::move(total_load), helper](
             int step, double share, std::span<const double> load) -> std::optional<equilibrium_state> {
    reference_solver finds(s);
    reference_answer answer = solve_for(finds, load, loads.work(step, share), step, share, helper);
    if (answer.how != outcome::found) return {};
    return equilibrium_state{std::move(answer.displacement), std::move(answer.pressed)};
  };
}

}  // namespace

fallback_solver fallback_to_reference(const linear_structure& s, load_history total_load) {
  return fallback(s, std::move(total_load), nullptr);
}

fallback_solver certifier::fallback() {
  return certify::fallback(structure_, total_load_, this);
}

bool certifier::search(int step, double share, std::span<double> displacement, std::span<int> isep) {
  return prover_ && prover_->search(step, share, displacement, isep);
}

namespace {

/// What the exact path says of a load for which doubles find no equilibrium, and cannot exclude one.
void decide_exactly(std::optional<followed_step> end, reference_answer& found) {
  if (!end) return;
  if (end->status != path_status::solved) {
    found.how = outcome::no_equilibrium;
    return;
  }
  found.displacement = std::move(end->displacement);
  found.pressed = std::move(end->closed);
  found.how = outcome::found;
}

path_status status_without(outcome how) {
  if (how == outcome::no_equilibrium) return path_status::mechanism;
  return how == outcome::none_seen ? path_status::path_ended : path_status::not_factored;
}

}  // namespace

path_end find_final_states(const linear_structure& s, int steps, const load_history& total_load,
                           std::span<observer* const> observers, certifier* helper,
                           const exact_follower& exactly) {
  const state_refiner refine = helper != nullptr ? helper->refiner() : nullptr;
  reference_solver finds(s);
  std::vector<double> total(s.dofs());
  path_end end;
  for (int step = 1; step <= steps; ++step) {
    std::fill(total.begin(), total.end(), 0.0);
    total_load(step, total);
    reference_answer found = solve_for(finds, total, total_load.work(step), step, 1.0, helper);
    if (found.how != outcome::found && found.how != outcome::no_equilibrium && exactly)
      decide_exactly(exactly(step), found);
    end.work.factors = finds.factorisations();
    if (found.how != outcome::found) return {status_without(found.how), step, 0.0, {}, end.work};
    std::vector<int> status;
    for (const char pressed : found.pressed) status.push_back(pressed != 0 ? in_contact : separated);
    const double rcond = finds.reciprocal_condition(holding(s, found.pressed));
    end.work.factors = finds.factorisations();
    tell_end({.step = step,
              .fraction = 1.0,
              .displacement = found.displacement,
              .isep = status,
              .rcond = rcond,
              .from_fallback = false,
              .from_reference = true},
             refine, observers);
    end.step = step;
  }
  return end;
}

}  // namespace contct::certify
