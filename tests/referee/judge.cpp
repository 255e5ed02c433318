#include "referee/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "contct/certify/certificate.hpp"
#include "contct/exact/kernel_digits.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct::referee {
namespace {

using namespace certify;
using namespace exact;
using structure::problem;

/// The kinds of numbers, in the order of the faults.
enum class number_kind { deflection, slope, force, reaction };
constexpr int number_kinds = 4;

/// What a step ended with.
struct kept_state {
  int step;
  std::vector<double> displacement;
  std::vector<int> isep;
  double rcond;
};

struct state_keeper final : observer {
  void step_ended(const step_state& s) override {
    lost = lost || s.from_fallback;
    states.push_back(
        {s.step, {s.displacement.begin(), s.displacement.end()}, {s.isep.begin(), s.isep.end()}, s.rcond});
  }

  std::vector<kept_state> states;
  bool lost = false;
};

double size_of(const rational& x) {
  return rounded(rational(abs(x)));
}

/// The longest side; 1 for a matrix.
double span_of(const structure::model& m) {
  if (const auto* b = std::get_if<beam>(&m.kind)) return b->x.back() - b->x.front();
  const auto* p = std::get_if<plate>(&m.kind);
  return p == nullptr ? 1.0 : std::max(p->x.back() - p->x.front(), p->y.back() - p->y.front());
}

/// The largest of each kind in an exact state. What is 0 by symmetry has no size of its own: slopes are
/// measured at least by the largest deflection over the span, moments at least by the largest force times it,
/// and deflections and forces that are all 0 by the largest slope times it and the largest moment over it.
struct sizes {
  double deflection = 0.0, slope = 0.0, force = 0.0, moment = 0.0;

  sizes() = default;
  sizes(const problem& p, const exact_problem& e, const exact_step& acting, const exact_step_end& state) {
    const std::size_t stride = dofs_per_node(p.geometry);
    const double span = span_of(p.geometry);
    for (std::size_t dof = 0; dof < e.dofs(); ++dof) {
      take(dof % stride == 0 ? deflection : slope, state.displacement[dof]);
      take(dof % stride == 0 ? force : moment, acting.load[dof]);
    }
    for (const rational& f : state.force) take(force, f);
    for (std::size_t i = 0; i < e.supports.size(); ++i)
      take(p.supports[i].dof == 0 ? force : moment, state.reactions[i]);
    slope = std::max(slope, deflection / span);
    if (deflection == 0.0) deflection = slope * span;
    moment = std::max(moment, force * span);
    if (force == 0.0) force = moment / span;
  }

  void include(const sizes& s) {
    deflection = std::max(deflection, s.deflection);
    slope = std::max(slope, s.slope);
    force = std::max(force, s.force);
    moment = std::max(moment, s.moment);
  }

 private:
  static void take(double& largest, const rational& x) { largest = std::max(largest, size_of(x)); }
};

double share(double error, double size) {
  if (error == 0.0) return 0.0;
  return size > 0.0 ? error / size : std::numeric_limits<double>::infinity();
}

/// Compares the states of one run with the exact ones.
class comparing {
 public:
  comparing(const problem& p, const linear_structure& s, const exact_answer& exactly, judgement& j)
      : p_(p), s_(s), exactly_(exactly), result_(j) {}

  void compare(const kept_state& k, const certificate& c) {
    const auto step = static_cast<std::size_t>(k.step - 1);
    if (step >= exactly_.path.steps.size() || exactly_.path.steps[step].fraction != 1) return;
    state_ = &exactly_.path.steps[step];
    kept_ = &k;
    judged_ = &c;
    here_ = {p_, exactly_.problem, exactly_.problem.steps[step], *state_};
    seen_.include(here_);
    worst_ = 0.0;
    ++result_.steps;
    result_.certified += c.exact ? 1 : 0;
    measure_as_certificate(k);
    if (exactly_.unique[step] != 0) compare_displacements();
    compare_forces();
    compare_reactions();
    compare_digits();
  }

 private:
  /// The lengths that the certificate measures by: see its header.
  void measure_as_certificate(const kept_state& k) {
    double stiffest = 0.0;
    for (std::size_t dof = 0; dof < k.displacement.size(); ++dof) {
      const double size = std::max(std::abs(k.displacement[dof]), size_of(state_->displacement[dof]));
      largest_scaled_ = std::max(largest_scaled_, scale(dof) * size);
      if (!s_.deflects(static_cast<int>(dof))) continue;
      largest_deflection_ = std::max(largest_deflection_, size);
      if (s_.fixed[dof] == 0) stiffest = std::max(stiffest, scale(dof));
    }
    largest_length_ =
        stiffest == 0.0 ? largest_deflection_ : std::max(largest_deflection_, largest_scaled_ / stiffest);
  }
  [[nodiscard]] double scale(std::size_t dof) const {
    return std::sqrt(s_.stiffness.diagonal(s_.row_of(dof)));
  }

  void compare_displacements() {
    const std::size_t stride = dofs_per_node(p_.geometry);
    for (std::size_t dof = 0; dof < kept_->displacement.size(); ++dof) {
      const bool deflects = dof % stride == 0;
      number(deflects ? number_kind::deflection : number_kind::slope, kept_->displacement[dof],
             state_->displacement[dof], deflects ? here_.deflection : here_.slope,
             deflects ? seen_.deflection : seen_.slope,
             deflects ? largest_length_ : largest_scaled_ / scale(dof), dof / stride);
    }
  }

  void compare_forces() {
    const std::size_t stride = dofs_per_node(p_.geometry);
    for (std::size_t i = 0; i < p_.pairs.size(); ++i) {
      const double w = kept_->displacement[static_cast<std::size_t>(p_.pairs[i].node) * stride];
      number(number_kind::force, force_of(p_.pairs[i], w, kept_->isep[i] == in_contact), state_->force[i],
             here_.force, seen_.force, seen_.force, i);
    }
  }

  void compare_reactions() {
    const auto step = static_cast<std::size_t>(kept_->step - 1);
    const std::vector<double> all = path::reactions(p_, p_.steps[step], kept_->displacement, kept_->isep);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_force = p_.supports[i].dof == 0;
      const double of_path = is_force ? seen_.force : seen_.moment;
      number(number_kind::reaction, all[i], state_->reactions[i], is_force ? here_.force : here_.moment,
             of_path, of_path, i);
    }
  }

  /// `size`: of its kind in this state, or, where that is nothing, `path_size`; `measure`: what the
  /// certificate's tolerance is a share of; `at`: node, pair or support, from 0.
  void number(number_kind kind, double given, const rational& exactly, double size, double path_size,
              double measure, std::size_t at) {
    constexpr double promised = 1e-6;
    ++result_.values;
    const double error = std::isfinite(given) ? size_of(binary_value(given) - exactly)
                                              : std::numeric_limits<double>::infinity();
    const double relative = share(error, size > 0.0 ? size : path_size);
    worst_ = std::max(worst_, relative);
    if (!judged_->exact) return;
    const auto report = [&](int first, double amount) {
      const auto what = static_cast<fault>(first + static_cast<int>(kind));
      result_.findings.push_back({what, amount,
                                  fmt::format("step {}, number {}: {:.17g}; exactly {}", kept_->step, at + 1,
                                              given, short_words(exactly, 20))});
    };
    if (error > judged_->tolerance * measure)
      report(static_cast<int>(fault::outside_deflection), share(error, judged_->tolerance * measure));
    if (relative > promised) report(static_cast<int>(fault::beyond_deflection), relative);
  }

  void compare_digits() {
    constexpr double all_digits = 16.0;
    const int claimed = digits_left(kept_->rcond);
    const double there = worst_ >= 1.0  ? 0.0
                         : worst_ > 0.0 ? std::min(-std::log10(worst_), all_digits)
                                        : all_digits;
    if (claimed - there <= 0.5) return;
    result_.findings.push_back({fault::digits, claimed - there,
                                fmt::format("step {}: claims {} digits; there are {:.1f}{}", kept_->step,
                                            claimed, there, judged_->exact ? ", certified" : "")});
  }

  const problem& p_;
  const linear_structure& s_;
  const exact_answer& exactly_;
  judgement& result_;
  const exact_step_end* state_ = nullptr;  // of the step that is compared, as are those below
  const kept_state* kept_ = nullptr;
  const certificate* judged_ = nullptr;
  sizes here_, seen_;
  double worst_ = 0.0;
  double largest_deflection_ = 0.0, largest_scaled_ = 0.0, largest_length_ = 0.0;
};

path_end solve(const problem& p, const linear_structure& s, way how,
               const std::vector<observer*>& observers) {
  if (how == way::final_only)
    return find_final_states(s, static_cast<int>(p.steps.size()), loads_of(p, s), observers);
  const auto leader = outside::make_kernel(how == way::listing ? "cpp" : "corrected");
  const std::string engine(how == way::default_engine ? quickest_engine(s) : "refactor");
  return path::follow(p, s, engine, *leader, observers, {0, fallback_to_reference(s)});
}

/// What is wrong with how it ended; nothing where that is right.
std::optional<finding> compare_ends(const path_end& end, const exact_path& exactly) {
  const auto found = [&](fault what, std::string_view words) {
    return finding{what, 1.0, fmt::format("step {}: {}", end.step, words)};
  };
  const bool same_step = end.step == static_cast<int>(exactly.steps.size());
  if (end.status == exactly.status && (end.status == path_status::solved || same_step)) return std::nullopt;
  if (end.status == path_status::not_factored) return found(fault::refused, "held but too ill-conditioned");
  if (end.status == path_status::solved)
    return found(fault::false_solution, "solved; there is no equilibrium");
  if (end.status == path_status::mechanism && exactly.status == path_status::solved)
    return found(fault::false_mechanism, "a mechanism is told; there is an equilibrium");
  return found(fault::other_end, "neither an equilibrium nor the mechanism that there is");
}

}  // namespace

std::string_view name_of(way w) {
  constexpr std::string_view names[] = {"default-engine", "refactor", "final-only", "1989-rule"};
  return names[static_cast<int>(w)];
}

std::string_view name_of(fault f) {
  constexpr std::string_view names[] = {"out-w",      "out-slope", "out-force", "out-react", "off-w",
                                        "off-slope",  "off-force", "off-react", "digits",    "solved!",
                                        "mechanism!", "refused",   "other-end", "events",    "fallback"};
  return names[static_cast<int>(f)];
}

exact_answer::exact_answer(const structure::problem& p)
    : problem(exact_problem_of(p)), path(follow_true_path(problem)) {
  lifted_solver holds(problem.stiffness, problem.fixed, problem.place);
  for (const exact_step_end& s : path.steps) {
    std::vector<added_spring> springs;
    for (std::size_t i = 0; i < problem.pairs.size(); ++i)
      if (s.force[i] > 0) springs.push_back({problem.pairs[i].dof, problem.pairs[i].stiffness});
    holds.factor(springs);
    unique.push_back(holds.free_motions().empty() ? 1 : 0);
  }
}

judgement judge(const structure::problem& p, const exact_answer& exactly, way how) {
  judgement j;
  std::optional<linear_structure> built;
  try {
    built = structure_of(p);
  } catch (const std::invalid_argument& e) {
    j.findings.push_back({fault::refused, 1.0, e.what()});
    return j;
  }
  state_keeper kept;
  digit_counter counter(p, exactly.path);
  certifier judged(*built, loads_of(p, *built));
  path_end end;
  try {
    end = solve(p, *built, how, {&kept, &counter, &judged});
  } catch (const no_factor& e) {
    j.findings.push_back({fault::refused, 1.0, e.what()});
    return j;
  }
  comparing compared(p, *built, exactly, j);
  for (std::size_t i = 0; i < kept.states.size(); ++i)
    if (judged.steps()[i]) compared.compare(kept.states[i], *judged.steps()[i]);
  if (how == way::listing) return j;
  if (kept.lost) j.findings.push_back({fault::fallback, 1.0, "the path was lost"});
  if (auto wrong = compare_ends(end, exactly.path)) {
    j.findings.push_back(*wrong);
    return j;
  }
  j.mechanism = end.status == path_status::mechanism;
  if (how == way::final_only) return j;
  constexpr double tie = 1e-9;
  const kernel_digits r = counter.result("corrected", end.status, tie);
  if (!r.same_events) j.findings.push_back({fault::other_events, 1.0, r.first_difference});
  return j;
}

}  // namespace contct::referee
