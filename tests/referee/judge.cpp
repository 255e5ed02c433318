#include "referee/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "contct/read/problem_file.hpp"
#include "contct/results/exact_run.hpp"
#include "support/bedded_beams.hpp"
#include "support/judged_run.hpp"

namespace contct::referee {
namespace {

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
    for (double sizes::*size : {&sizes::deflection, &sizes::slope, &sizes::force, &sizes::moment})
      this->*size = std::max(this->*size, s.*size);
  }

 private:
  static void take(double& largest, const rational& x) { largest = std::max(largest, size_of(x)); }
};

/// Compares the states of one run with the exact ones.
class comparing {
 public:
  comparing(const problem& p, const exact_answer& exactly, way how, judgement& j)
      : p_(p), exactly_(exactly), is_refined_(how != way::listing), result_(j) {}

  void compare(std::size_t step, const std::vector<double>& u, const end_numbers& n, const certificate& c) {
    if (step >= exactly_.path.steps.size() || exactly_.path.steps[step].fraction != 1) return;
    const exact_step_end& state = exactly_.path.steps[step];
    step_ = step + 1;
    judged_ = &c;
    here_ = {p_, exactly_.problem, exactly_.problem.steps[step], state};
    seen_.include(here_);
    worst_ = 0.0;
    ++result_.steps;
    result_.certified += c.certified ? 1 : 0;
    const std::size_t stride = dofs_per_node(p_.geometry);
    for (std::size_t dof = 0; dof < u.size() && exactly_.unique[step] != 0; ++dof) {
      const bool deflects = dof % stride == 0;
      number(deflects ? quantity::w : quantity::slope, u[dof], state.displacement[dof],
             deflects ? &sizes::deflection : &sizes::slope, dof / stride);
    }
    for (std::size_t i = 0; i < p_.pairs.size(); ++i)
      number(quantity::force, n.pair_forces[i], state.force[i], &sizes::force, i);
    for (std::size_t i = 0; i < n.reactions.size(); ++i) {
      const bool is_force = p_.supports[i].dof == 0;
      number(is_force ? quantity::reaction : quantity::moment, n.reactions[i], state.reactions[i],
             is_force ? &sizes::force : &sizes::moment, i);
    }
    const double digits = worst_ > 0.0 ? std::clamp(-std::log10(worst_), 0.0, 16.0) : 16.0;
    if (digits_of(c) - digits > 0.5)
      found(fault::digits, fmt::format("claims {} digits; there are {:.1f}", digits_of(c), digits));
    if (exactly_.unique[step] != 0 && is_refined_ && c.proved && !c.certified) found(fault::loose, c.problem);
  }

 private:
  void found(fault what, const std::string& words) {
    result_.findings.push_back({what, fmt::format("step {}: {}", step_, words)});
  }

  /// Compares a number with the exact one. The relative error refers to the largest number of the kind in the
  /// state or, if this is 0, on the path. `at`: node, pair or support, from 0.
  void number(quantity kind, double given, const rational& exactly, double sizes::*size, std::size_t at) {
    constexpr double promised = 1e-6, infinite = std::numeric_limits<double>::infinity();
    ++result_.values;
    const double error = std::isfinite(given) ? size_of(binary_value(given) - exactly) : infinite;
    const double scale = here_.*size > 0.0 ? here_.*size : seen_.*size;
    const double relative = error == 0.0 ? 0.0 : scale > 0.0 ? error / scale : infinite;
    worst_ = std::max(worst_, relative);
    if (!judged_->proved) return;
    const std::string words = fmt::format("number {} of kind {}: {:.17g}; exactly {}", at + 1,
                                          static_cast<int>(kind), given, short_words(exactly, 20));
    if (error > judged_->error[kind].value_or(infinite)) found(fault::outside, words);
    if (judged_->certified && relative > promised) found(fault::beyond, words);
  }

  const problem& p_;
  const exact_answer& exactly_;
  bool is_refined_;
  judgement& result_;
  // Of the step that is compared:
  std::size_t step_ = 0;
  const certificate* judged_ = nullptr;
  sizes here_, seen_;
  double worst_ = 0.0;
};

/// Returns the error in the end of the path, or nothing.
std::optional<finding> compare_ends(const path_end& end, const exact_path& exactly) {
  const auto found = [&](fault what, const char* words) {
    return finding{what, fmt::format("step {}: {}", end.step, words)};
  };
  const bool same_step = end.step == static_cast<int>(exactly.steps.size());
  if (end.status == exactly.status() && (end.status == path_status::solved || same_step)) return std::nullopt;
  if (end.status == path_status::not_factored) return found(fault::refused, "held but too ill-conditioned");
  if (end.status == path_status::solved)
    return found(fault::false_solution, "solved; there is no equilibrium");
  if (end.status == path_status::mechanism && exactly.status() == path_status::solved)
    return found(fault::false_mechanism, "a mechanism is told; there is an equilibrium");
  return found(fault::other_end, "neither an equilibrium nor the mechanism that there is");
}

void judge_run(const problem& p, const exact_answer& exactly, way how, judgement& j) {
  recorded_path recorded;
  const judged_run run(p,
                       how == way::final_only ? ""
                       : how == way::listing  ? "cpp"
                                              : "corrected",
                       true, how == way::default_engine ? "" : "refactor", &recorded.record);
  comparing compared(p, exactly, how, j);
  for (std::size_t i = 0; i < run.steps.size(); ++i)
    if (const auto& c = run.steps[i].judged) compared.compare(i, run.u(i + 1), run.numbers(i + 1), *c);
  if (how == way::listing) return;
  const bool exact = std::ranges::count(run.steps, origin::exact_path, &solved_step::from) > 0;
  const bool lost =
      how != way::final_only && std::ranges::count(run.steps, origin::reference, &solved_step::from) > 0;
  if (exact) j.findings.push_back({fault::exactly, "ended by the exact path"});
  if (lost) j.findings.push_back({fault::fallback, "the path was lost"});
  if (auto wrong = compare_ends(run.end, exactly.path)) return j.findings.push_back(*wrong);
  if (how == way::final_only || exact || lost) return;  // these paths do not have all events
  constexpr double tie = 1e-9;
  recorded.take(static_cast<const solved_path&>(run));
  const kernel_digits r = digits_on(recorded, "corrected", p, exactly.path, tie);
  if (!r.same_events) j.findings.push_back({fault::other_events, r.first_difference});
}

}  // namespace

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

judgement judge(const problem& p, const exact_answer& exactly, way how) {
  judgement j;
  try {
    judge_run(p, exactly, how, j);
  } catch (const no_factor& e) {
    j.findings.push_back({fault::refused, e.what()});
  } catch (const std::invalid_argument& e) {
    j.findings.push_back({fault::refused, e.what()});
  }
  return j;
}

judgement judge_meshes(std::uint64_t number) {
  const double length = std::pow(10.0, static_cast<double>(number % 13) - 6.0);
  const double force = std::pow(10.0, static_cast<double>(number % 11) - 5.0);
  const int elements = 8 << number % 5;
  constexpr int ratio = 4;
  const auto mesh_of = [&](int count) {
    return parse_problem(bedded(number, count, length, force), "beds.toml", reach::anywhere);
  };
  const proved_run coarse(mesh_of(elements));
  const proved_run fine(mesh_of(ratio * elements));
  judgement j;
  if (!coarse.certified() || !fine.certified()) return j;  // a mechanism
  ++j.steps;
  if (!coarse.error().not_proved.empty() || !fine.error().not_proved.empty()) return j;
  ++j.certified;
  for (const auto& [key, off] : differences(coarse.results(), fine.results(), ratio)) {
    ++j.values;
    if (!(off <= coarse.bound(key) + fine.bound(key)))
      j.findings.push_back({fault::outside, fmt::format("{} differs by {} between two meshes", key, off)});
  }
  return j;
}

}  // namespace contct::referee
