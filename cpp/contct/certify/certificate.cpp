#include "contct/certify/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "contct/matrix/cholesky.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/text/memory.hpp"

namespace contct {
namespace {

using outcome = reference_answer::outcome;

double share(double part, double whole) {
  return part > 0.0 ? part / whole : 0.0;
}

/// True if three copies of the sparse factor L fit into memory, and computing L L' takes about a minute or
/// less.
bool can_be_proved_by_columns(const linear_structure& s) {
  if (!sparse_factor::available()) return false;
  constexpr double most_flops = 5e10;
  const auto factor = sparse_factor::make(s.stiffness.columns());
  return 3 * factor->bytes() <= memory_limit() && factor->flops() <= most_flops;
}

/// Is there memory for the bands of the path and of the reference solution, and for two more during a proof?
bool can_be_proved(const linear_structure& s) {
  if (!s.stiffness.is_band()) return can_be_proved_by_columns(s);
  const std::int64_t width = s.stiffness.band().subdiagonals() + 1;
  constexpr std::int64_t bytes = 40;  // five doubles
  return bytes * s.dofs() * width <= memory_limit();
}

bool is_finite(std::span<const double> x) {
  return std::ranges::all_of(x, [](double part) { return std::isfinite(part); });
}

}  // namespace

int digits_of(const certificate& c) {
  constexpr int most = 15;
  if (!c.proved || !(c.worst_share < 1.0)) return 0;
  return c.worst_share > 0.0 ? std::min(most, static_cast<int>(-std::log10(c.worst_share))) : most;
}

certifier::certifier(const problem& p, const linear_structure& s, std::unique_ptr<exact_means> exactly)
    : problem_(p), structure_(s), total_load_(loads_of(p, s)), exactly_(std::move(exactly)) {
  for (int dof = 0; dof < s.dofs(); ++dof) {
    scale_.push_back(std::sqrt(s.stiffness.diagonal(s.row_of(dof))));
    const std::size_t at = dof;
    if (deflects(at) && s.fixed[at] == 0) largest_scale_ = std::max(largest_scale_, scale_[at]);
  }
  if (can_be_proved(s)) prover_ = std::make_unique<error_prover>(p, s, exactly_.get());
}

void certifier::step_ended(const step_state& s) {
  steps_.push_back(s.fraction == 1.0 ? std::optional(judge(s)) : std::nullopt);
}

void certifier::keep_proofs() {
  if (prover_) prover_->keep_proof();
}

bool certifier::all_certified() const {
  return std::ranges::all_of(steps_, [](const auto& c) { return c && c->certified; });
}

certificate certifier::judge(const step_state& s) {
  certificate c;
  if (!is_finite(s.displacement)) {
    c.problem = "a displacement is not a finite number";  // NaN would pass all comparisons below
    return c;
  }
  const std::vector<double> load = load_at(s.step);
  remember_sizes(s.displacement);
  c = proof_of(s);
  c.rcond = s.rcond;
  c.independent = !s.from_reference;
  if (c.certified) measure_state(s, load, c);
  // If the state is not unique, its displacements have no bound: pairs may be beyond their faces.
  const bool beyond_face = !c.unique && c.penetration > certified_share;
  if (!c.certified || beyond_face) compare(s, load, c);
  if (!c.certified) find_pulling_pair(s, c);
  constexpr double ill_conditioned = 1e-12;
  if (!c.certified && c.proved && structure_.truth && c.rcond < ill_conditioned)
    c.problem +=
        ". The stiffness is ill-conditioned: use fewer elements, or supports that hold the structure";
  return c;
}

std::vector<double> certifier::from_faces(int step, std::span<const double> displacement) const {
  std::vector<double> v(displacement.begin(), displacement.end());
  const std::vector<double> moved = total_load_.moved(step, v.size());
  for (std::size_t dof = 0; dof < moved.size(); ++dof) v[dof] -= moved[dof];
  return v;
}

std::vector<double> certifier::load_at(int step) const {
  std::vector<double> load(structure_.dofs());
  total_load_(step, load);
  return load;
}

/// Tries to prove bounds on the errors of a state. If is_certified has just judged the same state, returns
/// the certificate that it found.
certificate certifier::proof_of(const step_state& s) {
  if (last_ && last_->step == s.step && std::ranges::equal(last_->displacement, s.displacement)) {
    allowed_ = last_->allowed;
    return std::exchange(last_, std::nullopt)->what;
  }
  certificate c;
  if (!prover_) {
    c.problem =
        "no error bound is proved: the proof takes too much memory or time, or CHOLMOD is not built in";
    return c;
  }
  const reported_state handed = reported_state_at(problem_, s);
  take(prover_->bound(handed), s, c);
  if (c.proved && !c.certified)
    if (const std::optional<error_bounds> closer = prover_->bound_closely(handed)) take(*closer, s, c);
  return c;
}

/// Sets `c.pulling` to the pair with the largest tensile force, or to -1 if this force is negligible.
void certifier::find_pulling_pair(const step_state& s, certificate& c) const {
  double largest = 0.0;
  const std::vector<double> v = from_faces(s.step, s.displacement);
  for (std::size_t i = 0; i < structure_.pairs.size(); ++i) {
    const double force =
        force_of(structure_.pairs[i], structure_.seen_by_pair(i, v), s.isep[i] == in_contact);
    largest = std::max(largest, std::abs(force));
    if (-force > c.pull) {
      c.pulling = static_cast<int>(i);
      c.pull = -force;
    }
  }
  if (c.pull <= certified_share * largest) c.pulling = -1;
}

std::string certifier::status_words(std::size_t pair, const step_state& s) const {
  const contact_pair& p = structure_.pairs[pair];
  const std::vector<double> v = from_faces(s.step, s.displacement);
  const double off = p.surface * (p.face - structure_.seen_by_pair(pair, v));
  char text[120];
  (void)std::snprintf(text, sizeof text, "pair %zu is reported %s, but it is %s its face by %.2g", pair + 1,
                      s.isep[pair] == in_contact ? "in contact" : "separated",
                      s.isep[pair] == in_contact ? "off" : "beyond", std::abs(off));
  return text + unit_of(problem_, quantity::gap);
}

/// Describes the first measure of `c` above certified_share; empty if there is none.
std::string certifier::worst_of(const certificate& c) const {
  struct part {
    double share;
    const char* words;
    double whole;  // the length that `share` refers to; 0: `share` has no length
  };
  const part parts[] = {{c.displacement_error, "the deflections are off", largest_length()},
                        {c.shape_error, "the displacements are off", 0.0},
                        {c.penetration, "a separated pair is beyond its face", largest_length()},
                        {c.tension, "a pair in contact pulls: it is off its face", largest_length()},
                        {c.equilibrium, "loads and forces do not balance: they move the structure", 0.0}};
  for (const auto& [share, words, whole] : parts) {
    if (share <= certified_share) continue;
    const std::string of_largest = percent_words(share) + " of the largest";
    if (whole == 0.0) return std::string(words) + " by " + of_largest + " displacement";
    char size[40];
    (void)std::snprintf(size, sizeof size, " by %.2g", share * whole);
    return words + (size + unit_of(problem_, quantity::w)) + ", " + of_largest + " deflection";
  }
  return "";
}

void certifier::take(const error_bounds& b, const step_state& s, certificate& c) {
  c.unique = b.unique;
  if (!b.not_proved.empty()) {
    c.problem = "no error bound is proved: " + b.not_proved;
    return;
  }
  c.proved = true;
  c.proof = b.proof;
  c.error = b.error;
  c.pressure = b.pressure;
  c.allowed = allowed_.of(b, prover_->extent());
  c.worst_share = worst_share(c.error, c.allowed);
  c.problem = worst_bound(c.error, c.allowed, &problem_);
  c.rule =
      c.problem.empty() && b.wrong_status ? "a pair in contact at its face, a separated pair before it" : "";
  if (!c.rule.empty()) c.problem = status_words(*b.wrong_status, s);
  c.certified = c.problem.empty();
  c.displacement_error = share_of(c.error[quantity::w], c.allowed[quantity::w]);
  c.shape_error = c.worst_share;
}

/// Judges a state by its equilibrium, its contacts and its difference from the reference solution.
void certifier::compare(const step_state& s, std::span<const double> load, certificate& c) {
  const reference_answer answer = reference_at(s.step);
  remember_sizes(answer.displacement);
  c.displacement_error = c.shape_error = 0.0;
  c.unique = answer.unique;
  measure_state(s, load, c);
  const bool no_equilibrium = answer.how == outcome::no_equilibrium;
  const std::string of_proof = std::exchange(c.problem, "");
  const std::string rule_of_proof = std::exchange(c.rule, "");
  if (no_equilibrium) {
    c.problem =
        "there is no equilibrium: no support and no face stops a rigid-body motion on which the load does "
        "work";
  } else if (answer.how == outcome::none_seen) {
    c.problem =
        "there is no reference solution: in double precision, the load drives a rigid-body motion that "
        "nothing stops. Whether an equilibrium exists is not decided";
    const auto* const a = std::get_if<assembled>(&problem_.geometry.kind);
    if (a != nullptr && !a->free_motions && structure_.rigid_motions > 0)
      c.problem += ". " + nearly_free_words(structure_);
  } else if (answer.how == outcome::not_found) {
    c.problem = "there is no reference solution: the stiffness is too ill-conditioned";
  } else {
    if (c.unique) compare_with(answer, s, c);
    c.problem = worst_of(c);
  }
  // A reference solution outside the proved bounds of a state is less accurate than the state.
  const bool reference_is_off = answer.how != outcome::found ||
                                c.displacement_error * largest_length() >
                                    c.error[quantity::w].value_or(std::numeric_limits<double>::infinity());
  const bool of_bounds = c.proved && !of_proof.empty();
  if (c.problem.empty() || (of_bounds && !no_equilibrium && reference_is_off)) {
    c.problem = of_proof;
    c.rule = rule_of_proof;
  }
  c.certified = c.problem.empty();
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

/// Measures equilibrium, penetration and tension from the state alone.
void certifier::measure_state(const step_state& s, std::span<const double> load, certificate& c) const {
  const auto row = [this](std::size_t dof) { return structure_.row_of(static_cast<int>(dof)); };
  const std::vector<double> v = from_faces(s.step, s.displacement);
  std::vector<double> u(load.size());
  std::vector<long double> left(load.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    u[row(dof)] = v[dof];
    left[row(dof)] = structure_.in_row(dof, load[dof]);
  }
  structure_.stiffness.subtract_product(std::span<const double>(u), left);
  std::vector<double> stiffness(load.size());  // the diagonal of K with springs
  for (std::size_t dof = 0; dof < load.size(); ++dof) stiffness[dof] = scale_[dof] * scale_[dof];
  double deepest = 0.0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < structure_.pairs.size(); ++i) {
    const contact_pair& p = structure_.pairs[i];
    const std::size_t dof = structure_.dof_of_pair(static_cast<int>(i));
    const double seen = structure_.seen_by_pair(i, v);
    const double pressing = p.surface * (seen - p.face);
    if (s.isep[i] == separated) {
      deepest = std::max(deepest, pressing);
    } else {
      farthest = std::max(farthest, -pressing);
      if (structure_.fixed[dof] != 0) continue;  // the support carries the force
      const long double spring =
          static_cast<long double>(p.stiffness) * (static_cast<long double>(seen) - p.face);
      left[row(dof)] -= spring;
      stiffness[dof] += p.stiffness;
      if (p.other < 0) continue;
      left[row(structure_.other_of_pair(i))] += spring;
      stiffness[structure_.other_of_pair(i)] += p.stiffness;
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

reference_answer certifier::reference_at(int step) {
  if (!reference_) reference_.emplace(structure_);
  if (problem_.steps[step - 1].from_zero) reference_->start_undeformed();
  reference_answer answer = reference_->solve(load_at(step), total_load_.work(step));
  const std::vector<double> moved = total_load_.moved(step, answer.displacement.size());
  for (std::size_t dof = 0; dof < moved.size(); ++dof) answer.displacement[dof] += moved[dof];
  return answer;
}

namespace {

step_state told(const full_load_state& s, int step, double rcond) {
  return {.step = step,
          .fraction = 1.0,
          .displacement = s.displacement,
          .isep = s.isep,
          .rcond = rcond,
          .from_reference = s.from_reference,
          .from_exact_path = s.from_exact_path,
          .numbers = s.numbers ? &*s.numbers : nullptr};
}

full_load_state state_of(const reference_answer& a) {
  full_load_state s{.displacement = a.displacement, .isep = {}, .numbers = {}, .from_reference = true};
  for (const char pressed : a.pressed) s.isep.push_back(pressed != 0 ? in_contact : separated);
  return s;
}

path_status status_without(outcome how, const found_end& end) {
  if (how == outcome::no_equilibrium || end.exists == false) return path_status::mechanism;
  return how == outcome::none_seen ? path_status::path_ended : path_status::not_factored;
}

}  // namespace

/// Refines a state and returns true if it is then certified.
bool certifier::is_certified(int step, full_load_state& s) {
  last_.reset();
  if (!prover_ || !is_finite(s.displacement)) return false;
  s.numbers = prover_->refine(step, s.displacement, s.isep);
  const allowed_errors before = allowed_;
  const certificate c = proof_of(told(s, step, 0.0));
  last_ = {step, s.displacement, c, std::exchange(allowed_, before)};
  return c.certified;
}

/// Returns the final state of a step: the first that is certified among the refined state `reached` and the
/// state of the exact path or, if that path decides nothing, the reference solution. If neither is certified,
/// or a proof takes too much memory, returns the refined state `reached`, or the other state if `reached` is
/// null.
found_end certifier::end_of(int step, const full_load_state* reached) {
  std::optional<full_load_state> refined;
  if (reached != nullptr) {
    refined = *reached;
    if (is_certified(step, *refined) || !prover_) return {std::move(refined), true};
  }
  // A prover keeps the digits below double precision of one state: `refined` is refined again to restore its
  // digits.
  const auto kept = [&] {
    (void)is_certified(step, *refined);
    return found_end{std::move(refined), true};
  };
  if (found_end exactly = exactly_ ? exactly_->end_of(step) : found_end(); exactly.exists) {
    const bool is_better = !exactly.state || is_certified(step, *exactly.state) || !refined;
    return is_better ? std::move(exactly) : kept();
  }
  const reference_answer answer = reference_at(step);
  if (answer.how == outcome::no_equilibrium) return {std::nullopt, false};
  full_load_state reference = state_of(answer);
  if (is_certified(step, reference) || (answer.how == outcome::found && !refined))
    return {std::move(reference), true};
  return refined ? kept() : found_end();
}

end_finder certifier::ends() {
  return [this](int step, const full_load_state* reached) { return end_of(step, reached); };
}

path_end certifier::find_final_states(std::span<observer* const> observers) {
  path_end end;
  bool stands = true;  // the previous step was solved
  for (int step = 1; step <= std::ssize(problem_.steps); ++step) {
    if (!stands && !problem_.steps[step - 1].from_zero) continue;
    const reference_answer answer = reference_at(step);
    const full_load_state reference = state_of(answer);
    const found_end found = answer.how == outcome::no_equilibrium
                                ? found_end()
                                : end_of(step, answer.how == outcome::found ? &reference : nullptr);
    stands = found.state.has_value();
    end.take({stands ? path_status::solved : status_without(answer.how, found), step, stands ? 1.0 : 0.0});
    end.work.factors = reference_->factorisations();
    if (!stands) continue;
    for (observer* o : observers) o->step_ended(told(*found.state, step, reference_->reciprocal_condition()));
  }
  return end;
}

}  // namespace contct
