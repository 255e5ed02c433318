#include "referee/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "contct/certify/certificate.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/exact/kernel_digits.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct::referee {
namespace {

/// The kinds of numbers, in the order of the values of `fault`.
enum class number_kind { deflection, slope, force, reaction };
constexpr int number_kinds = 4;

struct kept_state {
  int step;
  std::vector<double> displacement;
  std::vector<int> isep;
  end_numbers numbers;
};

struct state_keeper final : observer {
  explicit state_keeper(const problem& p) : what(p) {}

  void step_ended(const step_state& s) override {
    lost = lost || (s.from_fallback && !s.from_exact_path);
    exact = exact || s.from_exact_path;
    states.push_back({s.step,
                      {s.displacement.begin(), s.displacement.end()},
                      {s.isep.begin(), s.isep.end()},
                      reported_state_at(what, s).numbers});
  }

  const problem& what;
  std::vector<kept_state> states;
  bool lost = false, exact = false;
};

double size_of(const rational& x) {
  return rounded(rational(abs(x)));
}

/// The largest number of each kind in an exact state. Some numbers are 0 by symmetry, so slopes are at least
/// deflections / span, moments at least forces * span, and, instead of 0, deflections are slopes * span and
/// forces moments / span.
struct sizes {
  double deflection = 0.0, slope = 0.0, force = 0.0, moment = 0.0;

  sizes() = default;
  sizes(const problem& p, const exact_problem& e, const exact_step& acting, const exact_step_end& state) {
    const std::size_t stride = dofs_per_node(p.geometry);
    const double side = extent_of(p.geometry);
    const double span = side > 0.0 ? side : 1.0;  // the span of a matrix is unknown
    for (std::size_t dof = 0; dof < e.dofs(); ++dof) {
      take(dof % stride == 0 ? deflection : slope, state.displacement[dof]);
      take(dof % stride == 0 ? force : moment, acting.force[dof]);
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
  comparing(const problem& p, const exact_answer& exactly, way how, judgement& j)
      : p_(p), exactly_(exactly), is_refined_(how != way::listing), result_(j) {}

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
    result_.certified += c.certified ? 1 : 0;
    if (exactly_.unique[step] != 0) compare_displacements();
    compare_forces();
    compare_reactions();
    compare_digits();
    compare_bounds(exactly_.unique[step] != 0);
  }

 private:
  void compare_displacements() {
    const std::size_t stride = dofs_per_node(p_.geometry);
    for (std::size_t dof = 0; dof < kept_->displacement.size(); ++dof) {
      const bool deflects = dof % stride == 0;
      number(deflects ? number_kind::deflection : number_kind::slope, kept_->displacement[dof],
             state_->displacement[dof], deflects ? here_.deflection : here_.slope,
             deflects ? seen_.deflection : seen_.slope, dof / stride);
    }
  }

  void compare_forces() {
    for (std::size_t i = 0; i < p_.pairs.size(); ++i)
      number(number_kind::force, kept_->numbers.pair_forces[i], state_->force[i], here_.force, seen_.force,
             i);
  }

  void compare_reactions() {
    const std::vector<double>& all = kept_->numbers.reactions;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_force = p_.supports[i].dof == 0;
      const double of_path = is_force ? seen_.force : seen_.moment;
      number(number_kind::reaction, all[i], state_->reactions[i], is_force ? here_.force : here_.moment,
             of_path, i);
    }
  }

  /// Returns the proved bound of a kind of number; for a reaction moment the bound of moments.
  [[nodiscard]] double bound_of(number_kind kind, std::size_t at) const {
    const bool of_moment = kind == number_kind::reaction && p_.supports[at].dof != 0;
    constexpr quantity quantities[] = {quantity::w, quantity::slope, quantity::force, quantity::reaction};
    const quantity q = of_moment ? quantity::moment : quantities[static_cast<int>(kind)];
    return judged_->error[q].value_or(std::numeric_limits<double>::infinity());
  }

  /// Compares a number with the exact one. The relative error refers to `size`, the largest number of the
  /// kind in the state, or to `path_size`, the largest on the path, if `size` is 0. `at`: node, pair or
  /// support, from 0.
  void number(number_kind kind, double given, const rational& exactly, double size, double path_size,
              std::size_t at) {
    constexpr double promised = 1e-6;
    ++result_.values;
    const double error = std::isfinite(given) ? size_of(binary_value(given) - exactly)
                                              : std::numeric_limits<double>::infinity();
    const double relative = share(error, size > 0.0 ? size : path_size);
    worst_ = std::max(worst_, relative);
    if (!judged_->proved) return;
    const auto report = [&](int first, double amount) {
      const auto what = static_cast<fault>(first + static_cast<int>(kind));
      result_.findings.push_back({what, amount,
                                  fmt::format("step {}, number {}: {:.17g}; exactly {}", kept_->step, at + 1,
                                              given, short_words(exactly, 20))});
    };
    const double bound = bound_of(kind, at);
    if (error > bound) report(static_cast<int>(fault::outside_deflection), share(error, bound));
    if (judged_->certified && relative > promised)
      report(static_cast<int>(fault::beyond_deflection), relative);
  }

  void compare_digits() {
    constexpr double all_digits = 16.0;
    const int claimed = digits_of(*judged_);
    const double there = worst_ >= 1.0  ? 0.0
                         : worst_ > 0.0 ? std::min(-std::log10(worst_), all_digits)
                                        : all_digits;
    if (claimed - there <= 0.5) return;
    result_.findings.push_back({fault::digits, claimed - there,
                                fmt::format("step {}: claims {} digits; there are {:.1f}{}", kept_->step,
                                            claimed, there, judged_->certified ? ", certified" : "")});
  }

  void compare_bounds(bool unique) {
    if (!unique || !is_refined_ || !judged_->proved || judged_->certified) return;
    result_.findings.push_back(
        {fault::loose, judged_->worst_share, fmt::format("step {}: {}", kept_->step, judged_->problem)});
  }

  const problem& p_;
  const exact_answer& exactly_;
  bool is_refined_;
  judgement& result_;
  // Of the step that is compared:
  const exact_step_end* state_ = nullptr;
  const kept_state* kept_ = nullptr;
  const certificate* judged_ = nullptr;
  sizes here_, seen_;
  double worst_ = 0.0;
};

path_end solve(const problem& p, const linear_structure& s, way how, const std::vector<observer*>& observers,
               certifier& judged) {
  if (how == way::final_only) return judged.find_final_states(observers);
  const auto leader = make_kernel(how == way::listing ? "cpp" : "corrected");
  const std::string engine(how == way::default_engine ? quickest_engine(s) : "refactor");
  return follow(p, s, engine, *leader, observers, {0, judged.ends()});
}

/// Returns the error in the end of the path, or nothing.
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
  constexpr std::string_view names[] = {"out-w",     "out-slope",  "out-force", "out-react", "off-w",
                                        "off-slope", "off-force",  "off-react", "loose",     "digits",
                                        "solved!",   "mechanism!", "refused",   "other-end", "events",
                                        "fallback",  "exactly"};
  return names[static_cast<int>(f)];
}

exact_answer::exact_answer(const contct::problem& p)
    : problem(exact_problem_of(p)), path(follow_corrected_path(problem)) {
  lifted_solver holds(problem.stiffness, problem.fixed, problem.place);
  for (const exact_step_end& s : path.steps) {
    std::vector<added_spring> springs;
    for (std::size_t i = 0; i < problem.pairs.size(); ++i)
      if (s.force[i] > 0) springs.push_back({problem.pairs[i].dof, problem.pairs[i].stiffness});
    holds.factor(springs);
    unique.push_back(holds.free_motions().empty() ? 1 : 0);
  }
}

namespace {

void judge_run(const problem& p, const exact_answer& exactly, way how, judgement& j) {
  const linear_structure s = structure_of(p);
  state_keeper kept(p);
  digit_counter counter(p, exactly.path);
  certifier judged(p, s, exact_means_of(p));
  const path_end end = solve(p, s, how, {&kept, &judged, &counter}, judged);
  comparing compared(p, exactly, how, j);
  for (std::size_t i = 0; i < kept.states.size(); ++i)
    if (judged.steps()[i]) compared.compare(kept.states[i], *judged.steps()[i]);
  if (how == way::listing) return;
  if (kept.exact) j.findings.push_back({fault::exactly, 1.0, "ended by the exact path"});
  if (kept.lost) j.findings.push_back({fault::fallback, 1.0, "the path was lost"});
  if (auto wrong = compare_ends(end, exactly.path)) {
    j.findings.push_back(*wrong);
    return;
  }
  // These paths do not have all events.
  if (how == way::final_only || kept.exact || kept.lost) return;
  constexpr double tie = 1e-9;
  const kernel_digits r = counter.result("corrected", end.status, tie);
  if (!r.same_events) j.findings.push_back({fault::other_events, 1.0, r.first_difference});
}

}  // namespace

judgement judge(const problem& p, const exact_answer& exactly, way how) {
  judgement j;
  const auto refused = [&j](const std::exception& e) {
    j.findings.push_back({fault::refused, 1.0, e.what()});
  };
  try {
    judge_run(p, exactly, how, j);
  } catch (const no_factor& e) {
    refused(e);
  } catch (const std::invalid_argument& e) {
    refused(e);
  }
  return j;
}

}  // namespace contct::referee
