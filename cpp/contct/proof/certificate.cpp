#include "contct/proof/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "contct/proof/reference_solution.hpp"
#include "contct/text/memory.hpp"

namespace contct {
namespace {

/// Is there memory for the bands of the path and of the reference solution, and for two more during a proof?
/// By columns: do three copies of the sparse factor L fit, and does computing L L' take at most about a
/// minute?
bool can_be_proved(const linear_structure& s) {
  if (s.stiffness.is_band()) {
    constexpr std::int64_t bytes = 40;  // five doubles
    return bytes * s.dofs() * (*s.stiffness.subdiagonals + 1) <= memory_limit();
  }
  if (!sparse_factor::available()) return false;
  constexpr double most_flops = 5e10;
  const auto factor = sparse_factor::make(s.stiffness);
  return 3 * factor->bytes() <= memory_limit() && factor->flops() <= most_flops;
}

bool is_finite(std::span<const double> x) {
  return std::ranges::all_of(x, [](double part) { return std::isfinite(part); });
}

/// Describes a pair whose status is wrong in the state `s`.
std::string status_words(const problem& p, std::size_t pair, const structure_state& s) {
  const pair_in<double> at = pairs_under(p, p.steps[s.step - 1])[pair];
  const double off = gap_of(at, at.seen_in(s.displacement), false);
  char text[120];
  (void)std::snprintf(text, sizeof text, "pair %zu is reported %s, but it is %s its face by %.2g", pair + 1,
                      s.closed(pair) ? "in contact" : "separated", s.closed(pair) ? "off" : "beyond",
                      std::abs(off));
  return text + unit_of(p, quantity::gap);
}

}  // namespace

void by_quantity::take(quantity q, double value) {
  std::optional<double>& largest = (*this)[q];
  largest =
      std::max(largest.value_or(0.0), std::isnan(value) ? std::numeric_limits<double>::infinity() : value);
}

int digits_of(const certificate& c) {
  constexpr int most = 15;
  if (!c.proved || !(c.worst_share < 1.0)) return 0;
  return c.worst_share > 0.0 ? std::min(most, static_cast<int>(-std::log10(c.worst_share))) : most;
}

certifier::certifier(const problem& p, const linear_structure& s, std::unique_ptr<exact_means> exactly,
                     bool keeps_proofs)
    : problem_(p), structure_(s), loads_(p, s), exactly_(std::move(exactly)) {
  if (can_be_proved(s)) prover_ = std::make_unique<error_prover>(p, s, exactly_.get(), keeps_proofs);
}

certifier::~certifier() = default;

/// Judges a state by its bounds.
certificate certifier::judged(error_bounds b, const structure_state& s) const {
  certificate c{std::move(b)};
  if (!c.not_proved.empty()) {
    c.problem = "no error bound is proved: " + c.not_proved;
    return c;
  }
  c.proved = true;
  c.allowed = allowed_errors(allowed_).of(c, extent_of(problem_.geometry));
  c.worst_share = worst_share(c.error, c.allowed);
  c.displacement_error = share_of(c.error[quantity::w], c.allowed[quantity::w]);
  const std::optional<double> allowed_gap =
      c.allowed[quantity::gap] ? c.allowed[quantity::gap] : certified_share * c.largest_deflection;
  c.penetration = share_of(c.beyond_face, allowed_gap);
  c.tension = share_of(c.off_face, allowed_gap);
  c.problem = worst_bound(c.error, c.allowed, &problem_);
  if (c.problem.empty() && c.wrong_status) {
    c.rule = "a pair in contact at its face, a separated pair before it";
    c.problem = status_words(problem_, *c.wrong_status, s);
  } else if (c.problem.empty() && !c.unique && c.penetration > certified_share) {
    // Displacements that are not unique have no bound, so a pair may be beyond its face although no status is
    // wrong.
    c.problem = "a separated pair is beyond its face by " + percent_words(c.penetration) +
                " of the largest deflection";
  }
  c.certified = c.problem.empty();
  return c;
}

/// Tries to prove bounds on the errors of a state.
solved_step certifier::proved(structure_state s) {
  solved_step c{std::move(s)};
  certificate& what = c.judged.emplace();
  if (!is_finite(c.displacement)) {
    what.problem = "a displacement is not a finite number";  // NaN would pass all comparisons of the proof
  } else if (!prover_) {
    what.problem =
        "no error bound is proved: the proof takes too much memory or time, or CHOLMOD is not built in";
  } else {
    const structure_state told = with_numbers(problem_, static_cast<const structure_state&>(c));
    what = judged(prover_->bound(told), c);
    if (what.proved && !what.certified && exactly_) what = judged(prover_->bound_closely(told), c);
  }
  return c;
}

/// Refines a state, and tries to prove its bounds.
solved_step certifier::refined(structure_state s) {
  if (prover_ && is_finite(s.displacement)) prover_->refine(s);
  return proved(std::move(s));
}

certificate certifier::certificate_of(const structure_state& s) {
  return *chosen(proved(s)).judged;
}

/// Counts the sizes of a state, which the allowed errors of later unloaded states are relative to.
solved_step certifier::chosen(solved_step s) {
  if (s.judged->proved) (void)allowed_.of(*s.judged, extent_of(problem_.geometry));
  return s;
}

reference_path& certifier::reference() {
  if (!reference_) reference_ = std::make_unique<reference_path>(problem_, structure_);
  return *reference_;
}

/// Returns the final state of a step: the first that is certified among the refined state `reached` and the
/// state of the exact path or, if that path decides nothing, the reference solution. If neither is certified,
/// or a proof takes too much memory, returns the refined state `reached`, or the other state if `reached` is
/// null. Tells in `end` if certainly no equilibrium exists.
std::optional<solved_step> certifier::best_end(int step, const structure_state* reached, path_end& end) {
  std::optional<solved_step> own;
  if (reached != nullptr) {
    own = refined(*reached);
    if (own->judged->certified || !prover_) return own;
  }
  solved_step found = exactly_ ? exactly_->end_of(step) : solved_step();
  if (!found.is_decided()) found = reference().end_of(step);
  if (found.status == path_status::mechanism) {
    end.has_equilibrium = false;
    return std::nullopt;
  }
  solved_step other = refined(static_cast<structure_state&&>(found));
  if (other.judged->certified || (found.status == path_status::solved && !own)) return other;
  return own;
}

std::optional<solved_step> certifier::settle(path_end& end, const std::optional<structure_state>& reached) {
  const bool is_whole = reached && end.status == path_status::solved;
  if (!end.by_1989_rule && end.has_equilibrium != false) {
    if (std::optional<solved_step> found = best_end(end.step, is_whole ? &*reached : nullptr, end)) {
      end = {path_status::solved, end.step};
      return chosen(*std::move(found));
    }
  } else if (!end.has_equilibrium && end.status != path_status::solved) {
    if (best_end(end.step, nullptr, end)) end.has_equilibrium = true;
  }
  if (!reached) return std::nullopt;
  solved_step s{*reached};
  if (s.fraction == 1.0) s.judged = certificate_of(s);
  return s;
}

/// Sets `pulling` to the pair with the largest tensile force, or to -1 if this force is negligible.
void certifier::find_pulling_pair(solved_step& s) const {
  certificate& c = *s.judged;
  double largest = 0.0;
  const std::vector<double> forces =
      statics_of(problem_, problem_.steps[s.step - 1], s.displacement, s.isep).pair_forces;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double force = forces[i];
    largest = std::max(largest, std::abs(force));
    if (-force > c.pull) {
      c.pulling = static_cast<int>(i);
      c.pull = -force;
    }
  }
  if (c.pull <= certified_share * largest) c.pulling = -1;
}

void certifier::complete(solved_step& s) const {
  if (!s.judged || s.judged->certified) return;
  find_pulling_pair(s);
  constexpr double ill_conditioned = 1e-12;
  if (structure_.has_equilibrium(loads_.work(s.step)) == false)
    s.judged->problem =
        "there is no equilibrium: no support and no face stops a rigid-body motion on which the load does "
        "work";
  else if (s.judged->proved && structure_.truth && s.rcond < ill_conditioned)
    s.judged->problem +=
        ". The stiffness is ill-conditioned: use fewer elements, or supports that hold the structure";
}

namespace {

/// The loop over steps. `way`, a path or reference_path, leads to the end of each step.
template <class Way>
solved_path ends_of(const problem& p, Way& way, certifier* proof, const std::set<int>& only = {}) {
  solved_path all;
  bool stands = true;  // the previous step was solved
  for (int step = 1; step <= std::ssize(p.steps); ++step) {
    if (!stands && !p.steps[step - 1].from_zero) continue;
    if (!only.empty() && !only.contains(step)) continue;
    path_end end = way.follow(step);
    std::optional<solved_step> s;
    if (proof != nullptr)
      s = proof->settle(end, way.now());
    else if (way.now())
      s = solved_step{*way.now()};
    if (s) {
      s->rcond = way.go_on_from(*s);
      if (proof != nullptr) proof->complete(*s);
      all.steps.push_back(*std::move(s));
    }
    end.conclude();
    stands = end.status == path_status::solved;
    all.end.take(std::move(end));
  }
  return all;
}

}  // namespace

solved_path certifier::find_final_states() {
  solved_path all = ends_of(problem_, reference(), this);
  all.end.work = reference().counts();
  return all;
}

solved_path follow(const problem& p, const linear_structure& s, std::string_view engine, kernel& leader,
                   const std::vector<observer*>& observers, certifier* proof, int max_increments,
                   const std::set<int>& only) {
  const std::unique_ptr<stiffness_engine> solves = make_engine(engine, s);
  const load_history loads(p, s);
  path way(s, loads, *solves, leader, observers, max_increments);
  solved_path all = ends_of(p, way, proof, only);
  all.end.work = solves->counts();
  return all;
}

}  // namespace contct
