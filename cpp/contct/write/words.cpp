#include "contct/write/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/kernel/registry.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/session/rule_1989.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// The number of correct digits at a relative error, up to 10: further digits depend on the LAPACK in use.
std::string digits_words(double error) {
  constexpr int enough = 10;
  const int digits = error > 0.0 ? static_cast<int>(-std::log10(error)) : enough;
  return digits >= enough ? fmt::format("{} digits or more", enough) : fmt::format("{} digits", digits);
}

/// The event that was farthest from the face of its pair, up to the end of a step, in words; empty if every
/// pair was at its face except for the rounding of deflections.
std::string worst_until(int step, const certificate& c, const problem& p, const early_toggles& early) {
  const double deflection = c.allowed[quantity::w].value_or(0.0) / certified_share;
  const early_toggle* worst = nullptr;
  for (const early_toggle& t : early.all()) {
    if (t.distance <= 1e-13 * deflection) continue;
    if (t.step <= step && (worst == nullptr || t.share > worst->share)) worst = &t;
  }
  if (worst == nullptr) return "";
  return fmt::format(
      "; in increment {}.{} {} {} contact {:.2g}{} from its face ({} of the largest deflection)", worst->step,
      worst->number, pair_words(p, worst->what.pair), worst->what.what == change::make ? "made" : "broke",
      worst->distance, unit_words(p, "w"), percent_words(worst->share));
}

/// Keeps the first 12 lines, because there may be hundreds of combinations.
std::vector<std::string> first_of(std::vector<std::string> lines) {
  constexpr std::size_t most = 12;
  if (lines.size() <= most) return lines;
  const std::size_t more = lines.size() - most;
  lines.resize(most);
  lines.push_back(fmt::format("and {} more combinations; --json has all of them", more));
  return lines;
}

std::string allowed_words(const certificate& c) {
  return c.rule.empty() ? percent_words(certified_share) : c.rule;
}

/// The pair in contact that pulls most, in words; empty if none pulls.
std::string pull_words(const certificate& c, const problem& p) {
  if (c.pulling < 0) return "";
  return fmt::format("; {} pulls with {:.3g}{}", pair_words(p, c.pulling), c.pull, unit_words(p, "force"));
}

}  // namespace

std::string event_names(std::span<const event> events) {
  std::vector<std::string> names;
  for (const event& e : events) names.push_back(fmt::format("{} {}", change_name(e.what), e.pair + 1));
  return joined(names, ", ");
}

std::string share_words(double x) {
  for (int digits = 8; digits > 1; --digits) {
    std::string text = fmt::format("{:.{}g}", x, digits);
    if (x < 1.0 && text == "1") return fmt::format("1-{:.0e}", 1.0 - x);
    if (text.size() <= 9) return text;
  }
  return fmt::format("{:.1g}", x);
}

std::string pair_words(const problem& p, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  const std::string other = at.other < 0 ? "" : " against " + place_words(p.geometry, at.other);
  return fmt::format("pair {} ({}{}, {})", pair + 1, place_words(p.geometry, at.node), other,
                     surface_name(at.surface));
}

std::string digits_words(const certificate& c) {
  constexpr int enough = 10;
  const int digits = digits_of(c);
  if (digits >= enough) return fmt::format("{}+ digits", enough);
  return fmt::format("{} digit{}", digits, digits == 1 ? "" : "s");
}

std::string step_words(const problem& p, int step) {
  return starts_from_zero(p) ? "combination " + in_quotes(p.steps[step - 1].name)
                             : fmt::format("step {}", step);
}

std::vector<std::string> certificate_summary(const run_result& r, bool solved) {
  const auto& steps = r.judged.steps();
  const auto name_of = [&](auto step) {
    return step_words(r.what, r.record.steps[step - steps.begin()].end.step);
  };
  const auto bad = std::ranges::find_if(steps, [](const auto& c) { return c && !c->certified; });
  if (bad != steps.end()) {
    return {fmt::format("{} is NOT certified: {}", name_of(bad), (*bad)->problem),
            "allowed: " + allowed_words(**bad)};
  }
  double worst = 0.0;
  const auto certified = std::ranges::count_if(steps, [](const auto& c) { return c.has_value(); });
  for (const auto& c : steps)
    if (c) worst = std::max(worst, c->worst_share);
  if (!solved && starts_from_zero(r.what))
    return {fmt::format("the run is NOT certified: only {} of {} combinations reach their full load",
                        certified, r.what.steps.size()),
            "these are certified"};
  if (!solved) {
    std::vector<std::string> items = {"the run is NOT certified: its path ended before the full load"};
    if (certified == 1) items.emplace_back("step 1 is certified");
    if (certified > 1) items.push_back(fmt::format("steps 1 to {} are certified", certified));
    return items;
  }
  const std::string states = certified == 1   ? "the final state is"
                             : certified == 2 ? "both final states are"
                                              : fmt::format("all {} final states are", certified);
  std::vector<std::string> items = {states + " certified",
                                    "proved: " + digits_words(worst) + " of every number"};
  const auto loose = std::ranges::find_if(steps, [](const auto& c) { return c && !c->unique; });
  if (loose != steps.end())
    items.push_back(fmt::format(
        "but the displacements of {} are not proved: a rigid-body motion remains free", name_of(loose)));
  return items;
}

std::vector<std::string> certificate_complaints(const run_result& r) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < r.judged.steps().size(); ++i) {
    const auto& c = r.judged.steps()[i];
    const int step = r.record.steps[i].end.step;
    if (c && !c->certified)
      lines.push_back(fmt::format("{} is not certified: {}; allowed: {}{}{}", step_words(r.what, step),
                                  c->problem, allowed_words(*c), pull_words(*c, r.what),
                                  worst_until(step, *c, r.what, r.early)));
  }
  return starts_from_zero(r.what) ? first_of(std::move(lines)) : lines;
}

namespace {

std::string words_of_pairs(const problem& p, const std::vector<int>& pairs) {
  constexpr std::size_t most_named = 8;
  std::string words;
  for (std::size_t i = 0; i < pairs.size() && i < most_named; ++i)
    words += (i == 0 ? "" : ", ") + pair_words(p, pairs[i]);
  if (pairs.size() > most_named) words += fmt::format(" and {} more", pairs.size() - most_named);
  return words;
}

std::string mechanism_words(const problem& p, const path_end& end) {
  if (end.pairs.empty())
    return "no equilibrium: the load of this step drives a rigid-body motion that no support and no pair "
           "stops. Add a support or a pair that stops it";
  return "no equilibrium: when " + words_of_pairs(p, end.pairs) +
         " separated, the structure became a mechanism";
}

/// The reason why nothing holds the structure, for a path that ended although there may be an equilibrium.
std::string loose_words(const problem& p, const path_end& end) {
  if (!end.pairs.empty())
    return "when " + words_of_pairs(p, end.pairs) + " separated, nothing held the structure";
  return end.by_1989_rule
             ? "the supports and the pairs in contact at the start do not hold the structure, which "
               "the 1989 rule needs"
             : "the supports and the pairs in contact do not hold the structure";
}

/// Tells whether the load has an equilibrium, which the path did not reach, and which rule reaches it.
std::string verdict_words(const path_end& end, bool is_answer) {
  if (!end.has_equilibrium)
    return ". Whether there is an equilibrium under the load of this step is not decided";
  if (!*end.has_equilibrium) return ". There is no equilibrium under the load of this step";
  return std::string(". There is an equilibrium under the load of this step") +
         (end.by_1989_rule && is_answer ? ": --kernels corrected reaches it" : "");
}

}  // namespace

std::vector<std::string> end_lines(const problem& p, const path_end& end) {
  if (end.status == path_status::solved) return {};
  std::vector<std::string> lines = {end_words(p, end)};
  for (const path_end& other : end.others) lines.push_back(end_words(p, other));
  return first_of(std::move(lines));
}

std::string end_words(const problem& p, const path_end& end, bool is_answer) {
  if (end.status == path_status::solved) return "";
  const auto verdict = [&] { return verdict_words(end, is_answer); };
  const std::string where =
      fmt::format("{}, at share {:.9g} of its load: ", step_words(p, end.step), end.fraction);
  switch (end.status) {
    case path_status::mechanism:
      return where + mechanism_words(p, end);
    case path_status::cycle:
      return where + "a cycle at constant load: these pairs change their status again and again: " +
             words_of_pairs(p, end.pairs) + verdict();
    case path_status::iteration_limit:
      return where + "the limit of increments (--max-increments) is reached" +
             (end.pairs.empty() ? ""
                                : "; these pairs change their status again and again: " +
                                      words_of_pairs(p, end.pairs) + verdict());
    case path_status::path_ended:
      return where + "the path ended: " + loose_words(p, end) + verdict();
    default:
      return where +
             "the structure is held, but its stiffness is too ill-conditioned, or its loads too large, for "
             "double precision: no digit of the answer would be right. Use fewer elements in a span, or "
             "stiffness and loads of less extreme size";
  }
}

std::string passage_warning(const problem& p, std::span<const step_record> steps) {
  const load_path loads(p);
  std::optional<penetration> worst;
  int step = 0;
  for (const step_record& s : steps) {
    const auto here = deepest_penetration(p, loads.at(s.end.step, s.end.fraction), s.end.displacement);
    if (!here || (worst && here->depth <= worst->depth)) continue;
    worst = here;
    step = s.end.step;
  }
  if (!worst) return "";
  const contact_pair& left = p.pairs[worst->first];
  return fmt::format(
      "{}: between pairs {} and {} the beam passes through their common face at {:g} by {:.2g}{} at x = "
      "{:.6g}. "
      "This is right if the pairs are separate stops; if one surface extends between them, put pairs closer "
      "together (at the nodes of a finer mesh: element_size)",
      step_words(p, step), worst->first + 1, worst->second + 1, left.face, worst->depth, unit_words(p, "w"),
      worst->x);
}

namespace {

/// The concentrated force on `node` of a plate, in words; empty if there is none. Moments are infinite at
/// such a node, except at a corner, where a force causes twisting moments of half its size. Pairs of beds do
/// not count, because each pair represents an area.
std::string concentrated_at(const problem& p, const load& l, const step_results& r, int node) {
  const auto& on = std::get<plate>(p.geometry.kind);
  const place at = place_of_node(p.geometry, node);
  const bool is_at_end = at.x == on.x.front() || at.x == on.x.back();
  if (is_at_end && (at.y == on.y.front() || at.y == on.y.back())) return "";
  for (const point_load& f : l.points)
    if (f.node == node && f.value * f.factor != 0.0) return "a point load";
  for (std::size_t i = 0; i < contacts_of(p); ++i)
    if (p.pairs[i].node == node && r.pairs[i].force != 0.0) return fmt::format("the force of pair {}", i + 1);
  return "";
}

}  // namespace

std::string concentration_warning(const problem& p, std::span<const step_record> steps) {
  if (!std::holds_alternative<plate>(p.geometry.kind)) return "";
  constexpr std::string_view names[] = {"von_mises", "mx", "my"};
  const load_path loads(p);
  std::size_t rank = std::size(names);
  double most = 0.0;
  std::string warning;
  for (const step_record& s : steps) {
    const load acting = loads.at(s.end.step, s.end.fraction);
    const step_results r = results_of(p, acting, s.end);
    for (const value_range& v : r.ranges) {
      const auto here = static_cast<std::size_t>(std::ranges::find(names, v.name) - std::begin(names));
      const placed_value& at = v.largest();
      const double size = std::abs(at.value);
      if (here == std::size(names) || here > rank || (here == rank && size <= most)) continue;
      const std::string what = concentrated_at(p, acting, r, at.node);
      if (what.empty()) continue;
      rank = here;
      most = size;
      warning = fmt::format(
          "{}: largest {} at {}, under {}: there the moments of a thin plate grow with every finer mesh. "
          "Spread the load, or the force of a bolt, over an area (uniform with from and to) for a finite "
          "stress",
          step_words(p, s.end.step), here == 0 ? "von Mises" : v.name, place_words(p.geometry, at), what);
    }
  }
  return warning;
}

std::string shear_warning(const problem& p, std::span<const step_record> steps) {
  constexpr double noticeable = 0.05;  // share of the largest shear
  if (!std::holds_alternative<beam>(p.geometry.kind) || p.beds.empty()) return "";
  const load_path loads(p);
  placed_value largest;
  double force = 0.0;  // of the pair there
  int step = 0;
  for (const step_record& s : steps) {
    const step_results r = results_of(p, loads.at(s.end.step, s.end.fraction), s.end);
    const placed_value& here = std::ranges::find(r.ranges, "shear", &value_range::name)->largest();
    if (std::abs(here.value) <= std::abs(largest.value)) continue;
    largest = here;
    step = s.end.step;
    force = 0.0;
    for (std::size_t i = contacts_of(p); i < p.pairs.size(); ++i)
      if (p.pairs[i].node == here.node) force = r.pairs[i].force;
  }
  const double share = force / 2 / std::abs(largest.value);
  if (!(share > noticeable)) return "";
  return fmt::format(
      "{}: the largest shear, {:.4g}{} at {}, may be {} too small: a bed acts at nodes, here with {:.3g}{}. "
      "Use a finer mesh (element_size)",
      step_words(p, step), largest.value, unit_words(p, "shear"), place_words(p.geometry, largest),
      percent_words(share), force, unit_words(p, "force"));
}

std::string digit_warning(std::span<const step_record> steps) {
  int fewest = 5;  // a state with 5 digits needs no warning
  const step_record* worst = nullptr;
  for (const step_record& s : steps) {
    // Refined states and states of the exact path do not lose digits.
    if (s.end.numbers || s.from_exact_path || digits_left(s.rcond) >= fewest) continue;
    fewest = digits_left(s.rcond);
    worst = &s;
  }
  if (worst == nullptr) return "";
  const std::string digits = fewest == 0   ? "no digit"
                             : fewest == 1 ? "about 1 digit"
                                           : fmt::format("about {} digits", fewest);
  return fmt::format(
      "step {}: {} of the answer can be relied on: the stiffness is ill-conditioned (rcond {:.1e}). Use "
      "fewer elements in a span, or more supports",
      worst->end.step, digits, worst->rcond);
}

namespace {

/// Advice on the pair that is stiffest relative to the structure, if rounding of w may change the force of
/// this pair by more than the force itself; otherwise empty.
std::string stiffness_advice(const run_result& r) {
  constexpr double rigid = 1e8;  // relative stiffness above which digits hardly change
  constexpr double too_stiff = 1e12;
  double most = too_stiff;
  std::string words;
  for (std::size_t i = 0; i < r.structure.pairs.size(); ++i) {
    const int dof = r.structure.dof_of_pair(i);
    const double own = r.structure.stiffness.diagonal(r.structure.row_of(dof));
    const double stiffness = r.structure.pairs[i].stiffness;
    if (r.structure.fixed[dof] != 0 || own == 0.0 || stiffness <= most * own) continue;
    most = stiffness / own;
    const double digit = std::pow(10.0, std::floor(std::log10(rigid * own)));
    words = fmt::format(
        "the cause may be the stiffness {:g} of {}, {:.0e} times the structure's stiffness at this dof: the "
        "rounding of w may change the contact force by as much as the force itself. The largest useful "
        "stiffness is {:.0e}; a larger stiffness changes only the 7th digit and later digits",
        stiffness, pair_words(r.what, i), most, std::floor(rigid * own / digit) * digit);
  }
  return words;
}

}  // namespace

std::vector<std::string> complaints_of(const run_result& r) {
  std::vector<std::string> lines = certificate_complaints(r);
  const std::string of_stiffness = stiffness_advice(r);
  if (!of_stiffness.empty() && (!lines.empty() || r.end.status == path_status::not_factored)) {
    lines.push_back(of_stiffness);
    return lines;
  }
  // If a step has no proved bounds, the corrected rule may have no bounds either.
  const bool is_bounded =
      std::ranges::all_of(r.judged.steps(), [](const auto& c) { return !c || c->proved; });
  if (!lines.empty() && is_bounded && !r.kernels.empty() &&
      facts_of_kernel(r.kernels.front()).rule == contact_rule::listing)
    lines.push_back(
        fmt::format("the corrected rule has no such errors: contct run {} --kernels corrected", r.file));
  return lines;
}

namespace {

std::vector<std::string> state_warnings(const run_result& r) {
  std::vector<std::string> lines = {r.end.status == path_status::solved ? digit_warning(r.record.steps) : "",
                                    passage_warning(r.what, r.record.steps),
                                    concentration_warning(r.what, r.record.steps),
                                    shear_warning(r.what, r.record.steps)};
  std::erase(lines, "");
  return lines;
}

}  // namespace

std::vector<std::string> end_messages(const run_result& r) {
  std::vector<std::string> lines = complaints_of(r);
  const std::vector<std::string> why = end_lines(r.what, r.end);
  for (const std::string& w : why) lines.push_back(r.file + ": " + w);
  for (const std::string& w : state_warnings(r)) lines.push_back("warning: " + w);
  return lines;
}

std::vector<std::string> warnings_of(const run_result& r) {
  std::vector<std::string> lines = r.what.warnings;
  const std::string begin = (r.file == "-" ? "standard input" : r.file) + ":";
  for (std::string& line : lines)  // so that results do not depend on the problem's folder
    if (line.starts_with(begin)) line.erase(0, line.find(": ", begin.size()) + 2);
  std::ranges::move(state_warnings(r), std::back_inserter(lines));
  return lines;
}

std::vector<std::string> refinement_words(const run_result& r) {
  const problem& p = r.what;
  std::vector<std::string> items;
  for (const auto& [kind, change, of] : r.refined) {
    const double percent = change == 0.0 ? 0.0 : 100 * change / of;
    const std::string by =
        0.0 < change && percent <= 1e-7
            ? fmt::format("less than 1e-07 % of {:.4g}{}", of, unit_words(p, kind))
            : fmt::format("{:.3g}{} ({:.2g} % of {:.4g})", change, unit_words(p, kind), percent, of);
    items.push_back(
        fmt::format("{}{} by {}", items.empty() ? "half the element size changes " : "", kind, by));
  }
  if (!items.empty() && std::holds_alternative<beam>(p.geometry.kind))
    items.emplace_back(p.beds.empty() ? "beams are exact between nodes"
                                      : "beams are exact between nodes; the changes come from the bed, which "
                                        "has twice as many pairs then");
  return items;
}

namespace {

/// Returns "1.2 kN, 4 % of the largest of its kind".
std::string size_words(const run_result& r, const state_difference& d) {
  return fmt::format("{:.3g}{}, {} of the largest of its kind", std::abs(d.value - d.right),
                     unit_of(r.what, d.what), percent_words(d.share));
}

std::string wrong_words(const run_result& r, const state_difference& d) {
  const std::string unit = unit_of(r.what, d.what);
  return fmt::format(
      "the 1989 rule is wrong in step {}: the {} of {} is {:.6g}{} instead of {:.6g}{}: off by {}", d.step,
      name_of_kind(d.what), d.at, d.value, unit, d.right, unit, size_words(r, d));
}

/// The words for states that agree within the tolerance, with the largest difference in `all`. `all` must not
/// be empty.
std::string agreement_words(const run_result& r, std::span<const state_difference> all) {
  constexpr double ten_digits = 1e-10;  // smaller differences depend on the LAPACK in use
  const auto worst = std::ranges::max_element(all, {}, &state_difference::share);
  const bool is_rounded = std::ranges::any_of(all, &state_difference::but_for_rounding);
  const std::string start = fmt::format("the 1989 rule comes to the same states{}{}",
                                        r.beside->same_events ? "" : " by other events",
                                        is_rounded ? ", but for numbers that are only rounding" : "");
  const std::string_view other = is_rounded ? "other " : "";
  if (worst->share < ten_digits)
    return fmt::format("{}: every {}number agrees to 10 digits or more", start, other);
  return fmt::format("{}: the largest {}difference is in the {} of {} in step {}: {}", start, other,
                     name_of_kind(worst->what), worst->at, worst->step, size_words(r, *worst));
}

/// The ends of all steps that were not solved.
std::vector<const path_end*> unsolved(const path_end& end) {
  std::vector<const path_end*> all;
  if (end.status != path_status::solved) all.push_back(&end);
  for (const path_end& other : end.others) all.push_back(&other);
  return all;
}

const path_end* in_step(const std::vector<const path_end*>& ends, int step) {
  const auto found = std::ranges::find(ends, step, &path_end::step);
  return found == ends.end() ? nullptr : *found;
}

/// Compares the ends of all steps that the answer or the 1989 rule does not solve.
std::vector<std::string> ended_words(const run_result& r) {
  const std::vector<const path_end*> mine = unsolved(r.end);
  const std::vector<const path_end*> its = unsolved(r.beside->end);
  std::vector<std::string> lines;
  for (const path_end* end : its) {
    const path_end* const right = in_step(mine, end->step);
    if (right != nullptr && right->status == end->status &&
        std::abs(right->fraction - end->fraction) <= same_share)
      continue;
    lines.push_back(fmt::format("the path of the 1989 rule ends {} (the answer does not depend on it): {}",
                                right == nullptr ? "early" : "otherwise", end_words(r.what, *end, false)));
  }
  for (const step_record& s : r.beside->record.steps) {
    const path_end* const right = s.end.fraction == 1.0 ? in_step(mine, s.end.step) : nullptr;
    if (right != nullptr && right->status == path_status::mechanism)
      lines.push_back("the 1989 rule is wrong in " + step_words(r.what, s.end.step) +
                      ": it reaches the full load, under which there is no equilibrium");
  }
  if (lines.empty() && !its.empty()) return {"the path of the 1989 rule ends in the same way"};
  return first_of(std::move(lines));
}

}  // namespace

std::vector<std::string> rule_1989_words(const run_result& r) {
  constexpr std::size_t most_named = 4;
  std::vector<std::string> lines;
  if (!r.beside) return lines;
  lines = ended_words(r);
  const std::vector<state_difference>& all = r.beside->differences;
  std::size_t wrong = 0;
  int first = 0;
  for (const state_difference& d : all) {
    if (!d.is_wrong()) continue;
    if (++wrong <= most_named) lines.push_back(wrong_words(r, d));
    if (first == 0) first = d.step;
  }
  if (wrong > most_named)
    lines.push_back(fmt::format("the 1989 rule is wrong in {} more steps", wrong - most_named));
  if (wrong > 0)
    lines.push_back(fmt::format(
        "contct explain {} --step {} shows which line of the listing causes the error", r.file, first));
  if (wrong == 0 && !all.empty()) lines.push_back(agreement_words(r, all));
  return lines;
}

}  // namespace contct
